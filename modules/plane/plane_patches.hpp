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

/// The largest connected component of the plane's support in the first `part` subsets, and the plane fitted to it
/// (Schnabel et al., 4.4). Nothing if the component has fewer than three points.
std::optional<FittedPatch> fit_patch(const FloatPlane& plane, const RandomSubsets& subsets, std::size_t part,
                                     const Tolerance& tolerance, const Connectivity& connectivity,
                                     const Context& context);

}  // namespace atrium::plane
