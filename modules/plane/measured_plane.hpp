#pragma once
#include <Eigen/Core>
#include <array>
#include <numbers>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/moments.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

inline constexpr double radians_per_degree = std::numbers::pi / 180.0;

/// A primitive's points in short: their moments about the frame's zero and their bounding rectangle in the plane.
struct MeasuredPlane {
  Plane plane;
  Moments moments;
  std::array<Eigen::Vector3d, 4> corners{};  ///< of the rectangle along the principal axes of the points
  /// RMS distance of the points to any plane, metres.
  double rms_to(const Plane& other) const;
  /// Largest distance of the rectangle to a plane, metres.
  double reach_to(const Plane& other) const;
  double area() const { return (corners[1] - corners[0]).norm() * (corners[3] - corners[0]).norm(); }
  /// Which squares of the rectangle hold points: `columns` along its first side. Their edge is 10 cm, or twice the
  /// points' spacing where that is more.
  double square = 0;
  int columns = 0, rows = 0;
  std::vector<bool> squares;
  /// Share of this one's occupied squares that lie over occupied ones of the other, seen along the other's normal.
  double share_over(const MeasuredPlane& other) const;
  /// Of the rectangles, seen along this one's normal, square metres; both boxed along this one's sides.
  double shared_area(const MeasuredPlane& other) const;
};

/// One for each primitive, in their order; one without points has no moments.
std::vector<MeasuredPlane> measure_planes(const PlanePrimitives& planes, const Context& context);

/// Mean residual of the primitives, weighted by their points: the noise, metres. 0 without points.
double mean_residual(const std::vector<MeasuredPlane>& planes);

}  // namespace atrium::plane
