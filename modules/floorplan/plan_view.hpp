#pragma once
#include "modules/floorplan/regions.hpp"

namespace atrium::floorplan {

/// Angle, in radians within ±45°, by which the plan's walls are turned from the axes: that of most of their length.
double wall_turn(const FloorPlan& plan);

/// The storey turned by minus `angle` about the plan's origin, so that walls at that angle are parallel to the axes.
PlanStorey turned(PlanStorey storey, double angle);

struct Bounds2 {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e300);
  bool empty() const { return low.x() > high.x(); }
  Eigen::Vector2d size() const { return empty() ? Eigen::Vector2d::Zero() : Eigen::Vector2d(high - low); }
  void add(const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

/// Of its walls.
Bounds2 wall_bounds(const PlanStorey& storey);
/// Of all that it holds.
Bounds2 bounds(const PlanStorey& storey);

}  // namespace atrium::floorplan
