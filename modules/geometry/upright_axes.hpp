#pragma once
#include <Eigen/Core>
#include <vector>

namespace atrium {

/// How much surface has a normal along a direction. The sign of the normal means nothing.
struct FacedArea {
  Eigen::Vector3d normal;
  double area = 0;
};

/// A direction that may be vertical: many surfaces are level or upright as seen along it.
struct UprightAxis {
  Eigen::Vector3d direction;
  double support = 0;  ///< share of the area that is within 5 degrees of level or upright
};

/// The vertical nearest to `start`: the direction that level surfaces (their normals along it) and walls (their normals
/// across it, so that two walls vote by their cross product) agree on, by area. Robust: an M-estimator (Tukey's
/// biweight) whose width shrinks from four degrees to one, so that slopes and leaning walls have no say. It begins at
/// the direction within `widest` degrees of `start` that most area agrees with. Stays at `start` where there is none.
Eigen::Vector3d refined_vertical(const std::vector<FacedArea>& faces, const Eigen::Vector3d& start, double widest);

/// The candidates for the vertical: found from the three axes of the frame, the normals of the largest areas and the
/// cross products of those. None is within 10 degrees of another; the axes of the frame come first.
std::vector<UprightAxis> upright_axes(const std::vector<FacedArea>& faces);

}  // namespace atrium
