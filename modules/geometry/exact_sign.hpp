#pragma once
#include <Eigen/Core>

namespace atrium {

/// Signs of determinants without rounding error: in double precision where its error bound decides, else in exact
/// expansions (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997).
/// Coordinates must be finite, and zero or between 1e-60 and 1e60 in magnitude: products then neither overflow nor
/// underflow.

/// 1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if they lie on a line.
int turn_sign(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// The side of the plane through a, b, c on which d lies: 1 where a, b, c are seen counter-clockwise, -1 on the other,
/// 0 if all four lie in a plane.
int plane_side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

}  // namespace atrium
