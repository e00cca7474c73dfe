#pragma once
#include <Eigen/Core>

#include "modules/types/building.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

/// Floor under a ceiling, seen from above, that no room holds.
struct CoveredFloor {
  double missing = 0;                               ///< in pieces of 2 m2 or more, square metres
  double largest = 0;                               ///< of these pieces, square metres
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< on the floor of the largest
};

/// Looks at squares of 25 cm (more if the planes spread over a kilometre) where a plane that looks up lies 1.8 m or
/// more under one that looks down, and at whether a room has 60 % of the height between them. Building and planes have
/// one origin, z up.
CoveredFloor covered_floor_without_room(const Building& building, const PlanePrimitives& planes);

}  // namespace atrium::layout
