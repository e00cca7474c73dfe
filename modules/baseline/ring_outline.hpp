#pragma once
#include <Eigen/Core>
#include <vector>

#include "modules/types/floor_plan.hpp"

namespace atrium::baseline {

/// Points on walls, seen from above.
struct WallPoints {
  std::vector<Eigen::Vector2d> places;
  std::vector<Eigen::Vector2d> normals;  ///< unit length, into the room; or none
};

struct OutlineLimits {
  double tolerance = 0.1;  ///< of Douglas and Peucker, metres
  double snap_angle = 20;  ///< sides within this of the main directions take them, degrees; 0: none do
  double reach = 0.15;     ///< sides move at most this far onto the wall's points, metres
};

/// The direction (radians, 0 … π/2) to which, or at right angles to which, the rings' sides run most.
double main_direction(const std::vector<PlanRing>& rings);

/// The same direction, from the normals of the walls that run within ten degrees of it (if there are normals): sides
/// of pixels give it to some tenths of a degree, normals by the thousand better.
double refined_direction(double direction, const WallPoints& walls);

/// A ring of few straight sides for one of many small ones: simplified (Douglas and Peucker 1973), sides turned into
/// the main direction, each moved onto the median of the wall points before it, and cut with its neighbours. Where that
/// would make a ring that crosses itself, it is tried with 1.5 and 2.25 times the tolerance, and at last the simplified
/// one is returned. The room is on the left of the ring.
PlanRing straight_outline(const PlanRing& ring, double direction, const WallPoints& walls, const OutlineLimits& limits);

/// Douglas and Peucker's simplification of a closed ring, as indices of the corners that stay, ascending.
std::vector<std::size_t> simplified(const PlanRing& ring, double tolerance);

}  // namespace atrium::baseline
