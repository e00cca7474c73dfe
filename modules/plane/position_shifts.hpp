#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::plane {

/// A surface that two positions saw: normal · (shift of b − shift of a) should be −offset.
struct SharedPlane {
  std::size_t a, b;  ///< positions
  Eigen::Vector3d normal;
  double offset;  ///< metres
  double area;    ///< square metres
};

/// The shifts of the positions that make shared planes agree, metres: least squares weighted by area, with Tukey's
/// weights of this scale (metres) against planes that are not shared. The first of the positions (at least one) stays;
/// the others are held by half a square metre of surface each, so that noise in the planes' normals moves none along
/// directions that no plane holds: a shift that surfaces of A m² want comes out as A / (A + 0.5) of it, and repeating
/// brings the rest. Time and memory grow with the number of planes, not with the square of that of positions. Throws
/// Cancelled.
std::vector<Eigen::Vector3d> position_shifts(const std::vector<SharedPlane>& planes, std::size_t positions,
                                             double scale, const Context& context);

}  // namespace atrium::plane
