#include "modules/floorplan/project.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "graph/api/text.hpp"
#include "modules/floorplan/caption.hpp"
#include "modules/floorplan/rooms.hpp"
#include "modules/floorplan/walls.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::floorplan {
namespace {

constexpr double furthest = 1e4;        // metres from the plan's origin
constexpr double abutting = 0.002;      // metres: pieces of a floor nearer than this are joined
constexpr double least_height = 0.001;  // metres: a ceiling that is less above its floor is not above it

void check(const Mesh& mesh, const Project::Params& params) {
  const std::size_t count = mesh.triangles.size();
  if (mesh.classes.size() != count)
    throw Error("the mesh has no classes: nothing tells its walls from its floors",
                "wire scene.merge's `structure`, or read a mesh that io.write_mesh wrote (.ply, .obj)");
  if ((!mesh.storeys.empty() && mesh.storeys.size() != count) ||
      (!mesh.primitives.empty() && mesh.primitives.size() != count))
    throw Error("the mesh's storeys or primitives are not as many as its triangles", "one per triangle, or none");
  if (params.min_thickness > params.max_thickness)
    throw Error(
        fmt::format("min_thickness ({} m) is above max_thickness ({} m)", params.min_thickness, params.max_thickness),
        "walls thinner than the first or thicker than the second are not drawn: swap them");
  if (!mesh.origin.allFinite()) throw Error("the mesh's origin is not finite", "coordinates are finite numbers");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite())
      throw Error(fmt::format("vertex {} of the mesh is not finite", v), "coordinates are finite numbers");
  for (std::size_t t = 0; t < count; ++t)
    for (const auto v : mesh.triangles[t])
      if (v >= mesh.vertices.size())
        throw Error(fmt::format("triangle {} of the mesh names vertex {} of {}", t, v, mesh.vertices.size()),
                    "vertices are counted from 0");
}

// A whole metre near the middle of the structure.
Eigen::Vector3d middle_of(const Mesh& mesh) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.classes[t] == SurfaceClass::object) continue;
    for (const auto v : mesh.triangles[t]) {
      low = low.cwiseMin(mesh.vertices[v]);
      high = high.cwiseMax(mesh.vertices[v]);
    }
  }
  if (!low.allFinite()) return mesh.origin;
  if ((high - low).maxCoeff() > furthest)
    throw Error(fmt::format("the structure is {:.0f} m wide", (high - low).maxCoeff()),
                fmt::format("a plan spans at most {:.0f} m; is the mesh in metres?", furthest));
  return (mesh.origin + 0.5 * (low + high)).array().round();
}

// The rotation that turns the mesh upright.
Eigen::Matrix3d upright(const Project::In& in, double tolerance) {
  const Eigen::Vector3d up =
      in.transform ? Eigen::Vector3d(in.transform->rotation.transpose() * Eigen::Vector3d::UnitZ()) : up_of(*in.mesh);
  if (up.z() >= std::cos(tolerance * std::numbers::pi / 180)) return Eigen::Matrix3d::Identity();
  return turn_between(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

std::vector<Surface> of_class(const std::vector<Surface>& surfaces, SurfaceClass wanted) {
  std::vector<Surface> result;
  for (const auto& s : surfaces)
    if (s.surface == wanted) result.push_back(s);
  return result;
}

double level_of(const std::vector<Surface>& surfaces) {
  std::vector<std::pair<double, double>> levels;  // and areas
  levels.reserve(surfaces.size());
  for (const auto& s : surfaces) levels.emplace_back(s.centre.z(), s.area);
  return levels.empty() ? 0 : weighted_quantile(std::move(levels), 0.5);
}

double lowest_of(const std::vector<Surface>& surfaces) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& s : surfaces)
    for (const auto& triangle : s.triangles)
      for (const auto& p : triangle) lowest = std::min(lowest, p.z());
  return lowest;
}

Region seen_from_above(const std::vector<Surface>& surfaces) {
  std::vector<PlanRing> rings;
  for (const auto& s : surfaces)
    for (const auto& [a, b, c] : s.triangles) rings.push_back({a.head<2>(), b.head<2>(), c.head<2>()});
  return closed(united(rings), abutting);
}

// What rooms are cut from: it reaches to the walls.
Region ground_of(const PlanStorey& storey, const Project::Params& params) {
  Region ground = storey.floors;
  if (ground.empty()) ground = storey.ceilings;
  if (params.room_extent == RoomExtent::floors_and_ceilings) ground = joined(ground, storey.ceilings);
  if (ground.empty()) return ground;
  std::vector<PlanRing> lines;
  for (const auto& wall : storey.walls)
    if (wall.thickness <= 0) lines.push_back(strip(wall.from, wall.to, abutting, 0));
  return closed(joined(joined(ground, storey.bodies), united(lines)), std::max(params.floor_gap, abutting));
}

// Of the floors, else of the foot of the walls, else nothing known.
void set_elevation(PlanStorey& storey, const std::vector<Surface>& floors, const std::vector<Surface>& surfaces) {
  const auto walls = of_class(surfaces, SurfaceClass::wall);
  storey.floor_known = !floors.empty() || !walls.empty();
  storey.elevation = floors.empty() ? lowest_of(walls.empty() ? surfaces : walls) : level_of(floors);
}

void set_height(PlanStorey& storey, const std::vector<Surface>& ceilings, double origin_z, const Context& context) {
  if (ceilings.empty() || !storey.floor_known) return;
  const double ceiling = level_of(ceilings);
  if (ceiling - storey.elevation >= least_height)
    storey.height = ceiling - storey.elevation;
  else
    context.warn(fmt::format(
        "the ceiling of storey {}, at {:.2f} m, is not above its floor, at {:.2f} m: its height is left unknown; are "
        "floors and ceilings swapped, or is the model upside down?",
        storey.index, origin_z + ceiling, origin_z + storey.elevation));
}

void set_room_heights(PlanStorey& storey, const std::vector<Surface>& ceilings, const Context& context) {
  if (!storey.floor_known) return;
  std::size_t below = 0;
  for (auto& room : storey.rooms) {
    const auto height = height_of(room, ceilings, storey.elevation);
    if (height && *height < least_height) ++below;
    if (height && *height >= least_height) room.height = *height;
  }
  if (below > 0 && storey.height > 0)
    context.warn(
        fmt::format("storey {}: the ceilings of {} of {} are not above its floor: their heights are left unknown",
                    storey.index, below, counted(storey.rooms.size(), "room")));
}

PlanStorey storey_of(const std::vector<Surface>& surfaces, double origin_z, const Project::Params& params,
                     const Context& context) {
  const auto floors = of_class(surfaces, SurfaceClass::floor), ceilings = of_class(surfaces, SurfaceClass::ceiling);
  PlanStorey storey;
  storey.index = surfaces.front().storey;
  set_elevation(storey, floors, surfaces);
  set_height(storey, ceilings, origin_z, context);
  const auto faces = wall_faces(surfaces, storey.elevation + params.cut_height);
  storey.walls = walls_of(faces, {params.min_thickness, params.max_thickness, params.parallel_angle, params.corner_gap,
                                  params.merge_distance, params.min_wall_length});
  std::vector<PlanRing> outlines;
  for (const auto& wall : storey.walls)
    if (wall.thickness > 0) outlines.push_back(wall.outline);
  storey.bodies = closed(united(outlines), 2 * abutting);
  storey.floors = seen_from_above(floors);
  storey.ceilings = seen_from_above(ceilings);
  if (floors.empty() && !ceilings.empty())
    context.warn(fmt::format("storey {} has no floor: its rooms are drawn from its ceilings", storey.index));
  storey.rooms = rooms_of(ground_of(storey, params), storey, faces,
                          {params.max_opening, params.min_room_width, params.min_room_area});
  set_room_heights(storey, ceilings, context);
  if (storey.walls.empty()) context.warn(fmt::format("storey {} has no walls", storey.index));
  if (storey.rooms.empty()) context.warn(fmt::format("storey {} has no rooms", storey.index));
  return storey;
}

}  // namespace

Project::Out Project::run(const In& in, const Params& params, Context& context) {
  const Mesh& mesh = *in.mesh;
  check(mesh, params);
  FloorPlan plan;
  plan.origin = middle_of(mesh);
  plan.to_plan.rotation = upright(in, params.upright_tolerance);
  plan.to_plan.translation = plan.origin - plan.to_plan.rotation * plan.origin;
  std::size_t dropped = 0;
  const auto surfaces = surfaces_of(mesh, plan.to_plan.rotation, plan.origin, dropped);
  if (dropped > 0) context.warn(fmt::format("{} without area left out", counted(dropped, "triangle")));
  if (surfaces.empty()) context.warn("the mesh has no walls, floors or ceilings: the plan is empty");
  std::size_t number = 0;
  for (std::size_t begin = 0, end = 0; begin < surfaces.size(); begin = end) {
    while (end < surfaces.size() && surfaces[end].storey == surfaces[begin].storey) ++end;
    context.check_cancelled();
    plan.storeys.push_back(
        storey_of({surfaces.begin() + begin, surfaces.begin() + end}, origin_height(plan), params, context));
    for (auto& room : plan.storeys.back().rooms) room.name = fmt::format("Room {}", ++number);
  }
  return {std::move(plan)};
}

}  // namespace atrium::floorplan
