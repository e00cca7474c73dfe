#include "modules/floorplan/door_leaf.hpp"

#include <algorithm>

#include "modules/floorplan/wall_pieces.hpp"

namespace atrium::floorplan {
namespace {

constexpr double widest_single = 1.3, widest_double = 2.6;  // metres

const PlanRoom* room_of(const PlanStorey& storey, std::int32_t index) {
  if (index < 0 || static_cast<std::size_t>(index) >= storey.rooms.size()) return nullptr;
  return &storey.rooms[static_cast<std::size_t>(index)];
}

double nearest_corner(const PlanRoom* room, const Eigen::Vector2d& p) {
  double nearest = 1e300;
  if (room != nullptr)
    for (const auto& corner : room->polygon.outline) nearest = std::min(nearest, (corner - p).norm());
  return nearest;
}

}  // namespace

bool DoorLeaf::left() const { return cross(closed - hinge, open - hinge) > 0; }

std::vector<DoorLeaf> door_leaves(const PlanOpening& opening, const PlanStorey& storey) {
  const double width = opening.width();
  if (opening.kind != "door" || !(width > 0) || width > widest_double) return {};
  const PlanRoom *a = room_of(storey, opening.room_a), *b = room_of(storey, opening.room_b);
  const bool to_left = b == nullptr || (a != nullptr && a->polygon.area() <= b->polygon.area());
  const Eigen::Vector2d along = (opening.to - opening.from) / width;
  const Eigen::Vector2d side = (to_left ? 1 : -1) * Eigen::Vector2d(-along.y(), along.x());
  const Eigen::Vector2d from = opening.from + 0.5 * opening.thickness * side;
  const Eigen::Vector2d to = opening.to + 0.5 * opening.thickness * side;
  const auto leaf = [&](const Eigen::Vector2d& hinge, const Eigen::Vector2d& closed) {
    return DoorLeaf{hinge, hinge + (closed - hinge).norm() * side, closed};
  };
  if (width > widest_single) {
    const Eigen::Vector2d middle = 0.5 * (from + to);
    return {leaf(from, middle), leaf(to, middle)};
  }
  const PlanRoom* room = to_left ? a : b;
  return {nearest_corner(room, to) < nearest_corner(room, from) ? leaf(to, from) : leaf(from, to)};
}

}  // namespace atrium::floorplan
