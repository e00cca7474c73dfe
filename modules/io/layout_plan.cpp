#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "modules/io/truth_json.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::io {
namespace {

using Ring = std::vector<Eigen::Vector3d>;

// The rotation that turns the rooms upright; the identity where they stand so.
Eigen::Matrix3d upright(const GroundTruth& truth) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const auto& room : truth.rooms) up += area_vector(room.outline);
  if (!(up.norm() > 0)) return Eigen::Matrix3d::Identity();
  up.normalize();
  if ((up - Eigen::Vector3d::UnitZ()).norm() < 1e-9) return Eigen::Matrix3d::Identity();
  return turn_between(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

PlanRing from_above(const Ring& ring) {
  PlanRing flat;
  for (const auto& p : ring) flat.emplace_back(p.head<2>());
  return flat;
}
PlanPolygon polygon_of(const TrueFace& face) {
  PlanPolygon polygon{from_above(face.outline), {}};
  for (const auto& hole : face.holes) polygon.holes.push_back(from_above(hole));
  if (area_vector(face.outline).z() > 0) return polygon;
  std::reverse(polygon.outline.begin(), polygon.outline.end());
  for (auto& hole : polygon.holes) std::reverse(hole.begin(), hole.end());
  return polygon;
}
double mean_height(const Ring& ring) {
  double sum = 0;
  for (const auto& p : ring) sum += p.z();
  return sum / static_cast<double>(ring.size());
}

// The wall's lower side, the room on its left.
PlanWall wall_of(const TrueFace& face) {
  PlanWall wall;
  const double bottom =
      std::min_element(face.outline.begin(), face.outline.end(), [](auto& a, auto& b) { return a.z() < b.z(); })->z();
  const Eigen::Vector2d right = Eigen::Vector2d(face.plane.normal.y(), -face.plane.normal.x()).normalized();
  double least = 1e300, most = -1e300;
  for (const auto& p : face.outline) {
    if (p.z() > bottom + 0.01) continue;
    const double along = right.dot(p.head<2>());
    if (along < least) wall.from = p.head<2>();
    if (along > most) wall.to = p.head<2>();
    least = std::min(least, along);
    most = std::max(most, along);
  }
  return wall;
}

}  // namespace

FloorPlan plan_of(const GroundTruth& truth) {
  FloorPlan plan;
  plan.origin = truth.origin;
  plan.to_plan.rotation = upright(truth);
  plan.to_plan.translation = truth.origin - plan.to_plan.rotation * truth.origin;
  const GroundTruth level = transformed(truth, plan.to_plan);
  std::map<std::int32_t, PlanStorey> storeys;
  std::map<std::int32_t, double> room_ceilings;
  for (const auto& face : level.faces) {
    auto& storey = storeys[face.storey];
    if (face.surface == SurfaceClass::floor) storey.floors.push_back(polygon_of(face));
    if (face.surface == SurfaceClass::ceiling) {
      storey.ceilings.push_back(polygon_of(face));
      auto& top = room_ceilings.try_emplace(face.room, -1e300).first->second;
      top = std::max(top, mean_height(face.outline));
    }
    if (face.surface == SurfaceClass::wall) storey.walls.push_back(wall_of(face));
  }
  for (std::size_t i = 0; i < level.rooms.size(); ++i) {
    const auto& room = level.rooms[i];
    auto& storey = storeys[room.storey];
    const double floor = mean_height(room.outline);
    storey.elevation = storey.rooms.empty() ? floor : std::min(storey.elevation, floor);
    const auto ceiling = room_ceilings.find(static_cast<std::int32_t>(i));
    const double height = ceiling == room_ceilings.end() ? 0 : ceiling->second - floor;
    storey.rooms.push_back({room.name, {from_above(room.outline), {}}, height});
    storey.height = std::max(storey.height, height);
  }
  for (auto& [index, storey] : storeys) {
    storey.index = static_cast<std::int32_t>(plan.storeys.size());
    plan.storeys.push_back(std::move(storey));
  }
  return plan;
}

}  // namespace atrium::io
