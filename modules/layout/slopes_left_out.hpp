#pragma once
#include <Eigen/Core>

#include "modules/types/building.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

/// Large sloping surfaces in or at rooms that are no face of the model.
struct SlopesLeftOut {
  double area = 0;                                  ///< of all of them, square metres
  double largest = 0;                               ///< of the largest, square metres
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< the middle of the largest
};

/// Planes that are neither upright nor level, of 2 m2 or more and a metre or more high, whose points mostly lie on no
/// face: leaning walls, vaults, undersides of stairs. Furniture hardly has such surfaces. Building and planes have one
/// origin, z up.
SlopesLeftOut slopes_left_out(const Building& building, const PlanePrimitives& planes);

}  // namespace atrium::layout
