#include "modules/floorplan/plan_view.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace atrium::floorplan {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;
constexpr double together = 0.035;  // radians, 2°: walls that count as one direction

double quarter_turn(double angle) { return angle - quarter * std::round(angle / quarter); }

void add(Bounds2& box, const std::vector<PlanPolygon>& polygons) {
  for (const auto& polygon : polygons)
    for (const auto& p : polygon.outline) box.add(p);
}

}  // namespace

double wall_turn(const FloorPlan& plan) {
  struct Direction {
    double angle, length;
  };
  std::vector<Direction> walls;
  for (const auto& storey : plan.storeys)
    for (const auto& wall : storey.walls) {
      const Eigen::Vector2d d = wall.to - wall.from;
      walls.push_back({quarter_turn(std::atan2(d.y(), d.x())), d.norm()});
    }
  double best = 0, best_length = 0;
  for (const auto& candidate : walls) {
    double length = 0, moment = 0;
    for (const auto& wall : walls) {
      const double off = quarter_turn(wall.angle - candidate.angle);
      if (std::abs(off) > together) continue;
      length += wall.length;
      moment += wall.length * off;
    }
    if (length <= best_length * (1 + 1e-9)) continue;
    best_length = length;
    best = quarter_turn(candidate.angle + moment / length);
  }
  return std::abs(best) < 1e-9 ? 0 : best;
}

PlanStorey turned(PlanStorey storey, double angle) {
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(-angle).toRotationMatrix();
  const auto turn_ring = [&](PlanRing& ring) {
    for (auto& p : ring) p = rotation * p;
  };
  const auto turn_polygon = [&](PlanPolygon& polygon) {
    turn_ring(polygon.outline);
    for (auto& hole : polygon.holes) turn_ring(hole);
  };
  for (auto& wall : storey.walls) {
    wall.from = rotation * wall.from;
    wall.to = rotation * wall.to;
    turn_ring(wall.outline);
  }
  for (auto& opening : storey.openings) {
    opening.from = rotation * opening.from;
    opening.to = rotation * opening.to;
    turn_ring(opening.outline);
  }
  for (auto* polygons : {&storey.bodies, &storey.floors, &storey.ceilings})
    for (auto& polygon : *polygons) turn_polygon(polygon);
  for (auto& room : storey.rooms) turn_polygon(room.polygon);
  return storey;
}

Bounds2 wall_bounds(const PlanStorey& storey) {
  Bounds2 box;
  for (const auto& wall : storey.walls) {
    if (wall.outline.empty()) {
      box.add(wall.from);
      box.add(wall.to);
    }
    for (const auto& p : wall.outline) box.add(p);
  }
  return box;
}

Bounds2 bounds(const PlanStorey& storey) {
  Bounds2 box = wall_bounds(storey);
  add(box, storey.floors);
  add(box, storey.ceilings);
  for (const auto& room : storey.rooms) add(box, {room.polygon});
  return box;
}

}  // namespace atrium::floorplan
