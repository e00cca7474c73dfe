#include "modules/floorplan/from_building.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/floorplan/building_walls.hpp"
#include "modules/floorplan/regions.hpp"
#include "modules/floorplan/walls.hpp"
#include "modules/types/building_rules.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::floorplan {
namespace {

constexpr double joint_reach = 0.004;  // metres: gaps between bodies of walls that are closed

void check_input(const Building& building, const FromBuilding::Params& params) {
  if (params.min_thickness > params.max_thickness)
    throw Error(
        fmt::format("min_thickness ({} m) is above max_thickness ({} m)", params.min_thickness, params.max_thickness),
        "walls thinner than the first or thicker than the second are not drawn: swap them");
  check(building);
}

/// The building in the plan's frame, relative to the plan's origin; sets the plan's frame.
Building placed(const FromBuilding::In& in, FloorPlan& plan) {
  const Building& source = *in.building;
  const Transform back = in.transform ? inverse(*in.transform) : Transform{};
  Eigen::AlignedBox3d box;
  for (const auto& v : source.vertices) box.extend(v);
  const Eigen::Vector3d middle = source.origin + (box.isEmpty() ? Eigen::Vector3d::Zero().eval() : box.center());
  plan.origin = (back.rotation * middle + back.translation).array().round();
  const Eigen::Vector3d up = back.rotation * Eigen::Vector3d::UnitZ();
  constexpr double level = 1e-9;
  if ((up - Eigen::Vector3d::UnitZ()).norm() > level)
    plan.to_plan.rotation = turn_between(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  plan.to_plan.translation = plan.origin - plan.to_plan.rotation * plan.origin;
  return with_origin(transformed(source, chained(back, plan.to_plan)), plan.origin);
}

PlanRing from_above(const std::vector<Eigen::Vector3d>& ring) {
  PlanRing result;
  for (const auto& p : ring) result.emplace_back(p.head<2>());
  return result;
}

/// Without corners that are none, if that is one polygon.
PlanPolygon polygon_of(const BuildingRoom& room) {
  PlanPolygon polygon{from_above(room.outline), {}};
  std::vector<PlanRing> holes;
  for (const auto& hole : room.holes) holes.push_back(from_above(hole));
  Region clean = minus(united({polygon.outline}), united(holes));
  if (clean.size() == 1) return std::move(clean.front());
  for (auto& hole : holes) polygon.holes.push_back(std::move(hole));
  return polygon;
}

Region seen_from_above(const Building& building, std::int32_t storey, SurfaceClass surface) {
  Region region;
  const auto flat = [&](const std::vector<std::uint32_t>& ring) {
    PlanRing result;
    for (const auto v : ring) result.emplace_back(building.vertices[v].head<2>());
    return result;
  };
  for (const auto& face : building.faces) {
    if (face.storey != storey || face.surface != surface) continue;
    std::vector<PlanRing> holes;
    for (const auto& hole : face.holes) holes.push_back(flat(hole));
    const Region part = minus(united({flat(face.outline)}), united(holes));
    region.insert(region.end(), part.begin(), part.end());
  }
  return joined(region, {});
}

PlanStorey storey_of(const Building& building, std::int32_t index, const std::vector<PlanPolygon>& rooms,
                     const FromBuilding::Params& params) {
  PlanStorey storey;
  storey.index = index;
  storey.elevation = building.storeys[static_cast<std::size_t>(index)].elevation;
  storey.height = building.storeys[static_cast<std::size_t>(index)].height;
  std::vector<std::int32_t> number(building.rooms.size(), -1);
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    const BuildingRoom& room = building.rooms[r];
    if (room.storey != index || rooms[r].outline.size() < 3) continue;
    number[r] = static_cast<std::int32_t>(storey.rooms.size());
    // Levels and shapes: walls and openings have marks of their own.
    const bool corrected = std::any_of(room.faces.begin(), room.faces.end(), [&](std::int32_t f) {
      const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
      return face.surface != SurfaceClass::wall && !face.corrections.empty();
    });
    storey.rooms.push_back({room.name, rooms[r], room.height, room.confidence, corrected});
  }
  constexpr double merge_distance = 0.001, min_length = 0.01;
  storey.walls = walls_of(
      wall_faces(building, index, params.cut_height, rooms),
      {params.min_thickness, params.max_thickness, wall_parallel_angle, params.corner_gap, merge_distance, min_length});
  mark_inferred(building, storey.walls);
  mark_corrected(building, storey.walls);
  storey.openings = plan_openings(building, index, rooms, number);
  interrupt(storey.walls, storey.openings);
  std::vector<PlanRing> outlines, in_floor, overhead;
  for (const auto& wall : storey.walls)
    if (wall.thickness > 0 && !wall.inferred) outlines.push_back(wall.outline);
  Region inside;
  for (const auto& room : storey.rooms) inside.push_back(room.polygon);
  storey.bodies = minus(closed(united(outlines), joint_reach), joined(inside, {}));
  for (const auto& opening : storey.openings)
    if (opening.kind == "slab") (opening.sill > 0.5 * storey.height ? overhead : in_floor).push_back(opening.outline);
  storey.floors = minus(seen_from_above(building, index, SurfaceClass::floor), united(in_floor));
  storey.ceilings = minus(seen_from_above(building, index, SurfaceClass::ceiling), united(overhead));
  return storey;
}

}  // namespace

FromBuilding::Out FromBuilding::run(const In& in, const Params& params, Context& context) {
  check_input(*in.building, params);
  Out out;
  const Building building = placed(in, out.plan);
  std::vector<PlanPolygon> rooms;
  for (const auto& room : building.rooms) {
    rooms.push_back(polygon_of(room));
    if (rooms.back().outline.size() < 3 || !(rooms.back().area() > 0)) {
      context.warn(fmt::format("'{}' has no outline: it is left out", room.name));
      rooms.back().outline.clear();
    }
  }
  if (building.rooms.empty()) {
    context.warn("the building has no rooms: the plan is empty");
    return out;
  }
  for (std::size_t s = 0; s < building.storeys.size(); ++s)
    out.plan.storeys.push_back(storey_of(building, static_cast<std::int32_t>(s), rooms, params));
  return out;
}

}  // namespace atrium::floorplan
