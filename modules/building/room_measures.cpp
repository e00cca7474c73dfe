#include "modules/building/room_measures.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/floorplan/regions.hpp"
#include "modules/geometry/plan_overlay.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/layout/face_rings.hpp"
#include "modules/layout/wall_pairs.hpp"

namespace atrium::building {
namespace {

using floorplan::Region;

PlanRing plan_ring(const Building& building, const std::vector<std::uint32_t>& ring) {
  PlanRing result;
  for (const auto v : ring) result.emplace_back(building.vertices[v].head<2>());
  return result;
}

/// What the room covers seen from above.
Region plan_region(const Building& building, const BuildingRoom& room) {
  constexpr double upwards = 1e-3;
  Region plan;
  for (const auto f : room.faces) {
    const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
    if (face.plane.normal.z() < upwards) continue;
    Region own = floorplan::united({plan_ring(building, face.outline)});
    for (const auto& hole : face.holes) own = floorplan::minus(own, floorplan::united({plan_ring(building, hole)}));
    plan = plan.empty() ? std::move(own) : floorplan::joined(plan, own);
  }
  constexpr double least = 1e-4;  // square metres
  std::erase_if(plan, [&](const PlanPolygon& polygon) { return polygon.area() < least; });
  for (auto& polygon : plan)
    std::erase_if(polygon.holes, [&](const PlanRing& hole) { return std::abs(area(hole)) < least; });
  return plan;
}

/// Clipper's corners where the room's own are.
std::vector<Eigen::Vector3d> raised_ring(const Building& building, const BuildingRoom& room, const PlanRing& ring,
                                         double height) {
  constexpr double rounding = 1e-5;
  std::vector<Eigen::Vector3d> result;
  for (const auto& p : ring) {
    Eigen::Vector2d best = p;
    double least = rounding;
    for (const auto f : room.faces)
      for (const auto v : building.faces[static_cast<std::size_t>(f)].outline) {
        const double off = (building.vertices[v].head<2>() - p).norm();
        if (off >= least) continue;
        least = off;
        best = building.vertices[v].head<2>();
      }
    result.emplace_back(best.x(), best.y(), height);
  }
  return result;
}

PlanPolygon plan_polygon(const BuildingRoom& room) {
  const auto flat = [](const std::vector<Eigen::Vector3d>& ring) {
    PlanRing result;
    for (const auto& p : ring) result.emplace_back(p.head<2>());
    return result;
  };
  PlanPolygon result{flat(room.outline), {}};
  for (const auto& hole : room.holes) result.holes.push_back(flat(hole));
  return result;
}

struct Heights {
  double low = 1e300, high = -1e300;
  explicit Heights(const Building& building, const BuildingRoom& room) {
    for (const auto f : room.faces)
      for (const auto v : building.faces[static_cast<std::size_t>(f)].outline) {
        low = std::min(low, building.vertices[v].z());
        high = std::max(high, building.vertices[v].z());
      }
  }
};

/// Whether an opening's polygon, made narrower all around by `slack`, lies in its face.
bool fits_face(const Building& building, const BuildingFace& face, const std::vector<Eigen::Vector3d>& outline,
               double slack) {
  const PlaneFrame frame = upright_frame(face.plane, building.vertices[face.outline[0]]);
  PlanRing ring;
  for (const auto& p : outline) ring.push_back(frame.to_plane(p));
  const Region narrower = floorplan::grown(floorplan::united({ring}), -slack);
  const PlanPolygon polygon = flat_polygon(building, face);
  return !narrower.empty() && std::all_of(narrower.begin(), narrower.end(),
                                          [&](const PlanPolygon& part) { return overlay::covers(polygon, part); });
}

std::vector<std::int32_t> crossing_faces(const Building& building, const std::vector<std::int32_t>& rooms) {
  std::vector<std::int32_t> result;
  for (const auto r : rooms)
    for (const auto f : building.rooms[static_cast<std::size_t>(r)].faces)
      if (!overlay::is_valid(flat_polygon(building, building.faces[static_cast<std::size_t>(f)]))) result.push_back(f);
  return result;
}

void check_surfaces(const CorrectionDraft& draft, const Correction& correction, const std::vector<std::int32_t>& rooms,
                    std::size_t crossing_before) {
  for (const auto r : rooms) {
    std::vector<BuildingFace> faces;
    const BuildingRoom& room = draft.building.rooms[static_cast<std::size_t>(r)];
    for (const auto f : room.faces) faces.push_back(draft.building.faces[static_cast<std::size_t>(f)]);
    if (!is_closed(faces))
      correction.fail({}, fmt::format("'{}' would not be closed any more", room.name), "give smaller steps");
  }
  const auto crossing = crossing_faces(draft.building, rooms);
  if (crossing.size() > crossing_before)
    correction.fail({}, fmt::format("{} would cross itself", draft.face_name(crossing.front())),
                    "a wall moved through another one, or a height beyond its neighbour's");
}

void check_openings(const CorrectionDraft& draft, const Correction& correction, std::int32_t room) {
  constexpr double slack = 0.021;  // metres: openings as they are found may reach beyond their face by 2 cm
  const Building& building = draft.building;
  for (std::size_t o = 0; o < building.openings.size(); ++o) {
    const BuildingOpening& opening = building.openings[o];
    const auto side = [&](std::int32_t face, const std::vector<Eigen::Vector3d>& outline) {
      if (face < 0 || outline.size() < 3 || building.faces[static_cast<std::size_t>(face)].room != room) return;
      if (!fits_face(building, building.faces[static_cast<std::size_t>(face)], outline, slack))
        correction.fail(
            {},
            fmt::format("{} would reach beyond its wall, {} of '{}'", draft.opening_name(static_cast<std::int32_t>(o)),
                        draft.face_name(face), building.rooms[static_cast<std::size_t>(room)].name),
            "change or drop it first, with change_opening or drop_opening");
    };
    side(opening.face_a, opening.outline_a);
    side(opening.face_b, opening.outline_b);
  }
}

/// The height at which a storey has most of its level floors.
double main_level(const Building& building, std::int32_t storey, double otherwise) {
  constexpr double one_level = 0.001, level = 0.999;
  std::vector<std::pair<double, double>> levels;  // height, area
  for (const auto& face : building.faces) {
    if (face.storey != storey || face.room < 0 || face.plane.normal.z() < level) continue;
    const double height = building.vertices[face.outline[0]].z(), area = flat_polygon(building, face).area();
    const auto found = std::find_if(levels.begin(), levels.end(),
                                    [&](const auto& l) { return std::abs(l.first - height) < one_level; });
    if (found == levels.end())
      levels.emplace_back(height, area);
    else
      found->second += area;
  }
  const auto most =
      std::max_element(levels.begin(), levels.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == levels.end() ? otherwise : most->first;
}

void settle_elevations(Building& building) {
  for (std::size_t s = 0; s < building.storeys.size(); ++s) {
    double& elevation = building.storeys[s].elevation;
    elevation = main_level(building, static_cast<std::int32_t>(s), elevation);
    for (auto& room : building.rooms) {
      if (room.storey != static_cast<std::int32_t>(s)) continue;
      for (auto& p : room.outline) p.z() = elevation;
      for (auto& hole : room.holes)
        for (auto& p : hole) p.z() = elevation;
    }
  }
}

}  // namespace

bool measure_room(Building& building, std::int32_t index) {
  BuildingRoom& room = building.rooms[static_cast<std::size_t>(index)];
  const double height =
      room.outline.empty() ? building.storeys[static_cast<std::size_t>(room.storey)].elevation : room.outline[0].z();
  const Region plan = plan_region(building, room);
  if (plan.size() != 1) return false;
  room.outline = raised_ring(building, room, plan.front().outline, height);
  room.holes.clear();
  for (const auto& hole : plan.front().holes) room.holes.push_back(raised_ring(building, room, hole, height));
  room.area = vector_area(room.outline).z();
  for (const auto& hole : room.holes) room.area += vector_area(hole).z();
  room.volume = 0;
  for (const auto f : room.faces) {
    const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
    double area = layout::signed_area(face.outline, building.vertices, face.plane.normal);
    for (const auto& hole : face.holes) area += layout::signed_area(hole, building.vertices, face.plane.normal);
    room.volume -= area * face.plane.normal.dot(building.vertices[face.outline[0]]) / 3;
  }
  room.height = room.area > 0 ? room.volume / room.area : 0;
  return room.area > 0 && room.volume > 0;
}

Overlap overlap_of(const Building& building, const std::vector<std::int32_t>& rooms) {
  constexpr double common_height = 0.01;  // metres
  Overlap result;
  result.crossing = crossing_faces(building, rooms).size();
  double most = 0;
  for (const auto r : rooms) {
    const BuildingRoom& room = building.rooms[static_cast<std::size_t>(r)];
    const Heights heights(building, room);
    const PlanPolygon plan = plan_polygon(room);
    for (std::size_t o = 0; o < building.rooms.size(); ++o) {
      if (static_cast<std::int32_t>(o) == r) continue;
      const Heights other(building, building.rooms[o]);
      if (std::min(heights.high, other.high) - std::max(heights.low, other.low) < common_height) continue;
      const double shared = floorplan::area(floorplan::common({plan}, {plan_polygon(building.rooms[o])}));
      result.area += shared;
      if (shared <= most) continue;
      most = shared;
      result.room = r;
      result.other = static_cast<std::int32_t>(o);
    }
  }
  return result;
}

void settle_rooms(CorrectionDraft& draft, const Correction& correction, const std::vector<std::int32_t>& rooms,
                  const Overlap& before) {
  check_surfaces(draft, correction, rooms, before.crossing);
  for (const auto r : rooms)
    if (!measure_room(draft.building, r))
      correction.fail({}, fmt::format("the plan of '{}' would fall apart", draft.room(r).name), "give smaller steps");
  constexpr double rounding = 1e-3;  // square metres
  const Overlap after = overlap_of(draft.building, rooms);
  if (after.area > before.area + rounding && after.room >= 0)
    correction.fail(
        {},
        fmt::format("'{}' would reach {:.2f} m2 into '{}'", draft.room(after.room).name, after.area - before.area,
                    draft.room(after.other).name),
        correction.name == "move_wall" ? "a smaller `by`; or `both: true`, which moves the whole wall" : "");
  for (const auto r : rooms) check_openings(draft, correction, r);
}

void settle_building(CorrectionDraft& draft, bool floors) {
  Building& building = draft.building;
  building.walls = layout::wall_pairs(building, draft.max_thickness);
  for (auto& opening : building.openings) {
    if (opening.face_a >= 0 && opening.face_b >= 0 && opening.outline_a.size() >= 3)
      opening.thickness = std::abs(
          building.faces[static_cast<std::size_t>(opening.face_b)].plane.signed_distance(opening.outline_a[0]));
    if ((opening.face_a < 0) == (opening.face_b < 0)) continue;
    const BuildingFace& only = building.faces[static_cast<std::size_t>(std::max(opening.face_a, opening.face_b))];
    if (only.backing > 0) opening.thickness = only.backing;
  }
  if (floors) settle_elevations(building);
  std::vector<double> areas(building.storeys.size(), 0), volumes(building.storeys.size(), 0);
  for (const auto& room : building.rooms) {
    areas[static_cast<std::size_t>(room.storey)] += room.area;
    volumes[static_cast<std::size_t>(room.storey)] += room.volume;
  }
  for (std::size_t s = 0; s < areas.size(); ++s)
    if (areas[s] > 0) building.storeys[s].height = volumes[s] / areas[s];
}

}  // namespace atrium::building
