#pragma once
#include <optional>

#include "modules/plane/assignment.hpp"
#include "modules/plane/candidates.hpp"
#include "modules/plane/local_spacing.hpp"
#include "modules/plane/random_subsets.hpp"

namespace atrium::plane {

/// Points of a plane nearer to each other than `cluster_distance` are connected; 0: what the cloud's spacing around the
/// plane wants, at least 3 cm.
struct Connectivity {
  const LocalSpacing& spacing;
  double cluster_distance = 0;
};

/// A candidate's largest connected component, fitted.
struct FittedPatch {
  Patch patch;
  Support support;  ///< what it takes out of the subsets
  std::size_t points = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< of its points
};

/// Refits the plane to its support, on ever more points, and keeps the largest connected component (Schnabel et
/// al., 4.4). Nothing if that component has fewer than three points.
std::optional<FittedPatch> fit_patch(FloatPlane plane, const RandomSubsets& subsets, const Tolerance& tolerance,
                                     const Connectivity& connectivity, const Context& context);

}  // namespace atrium::plane
