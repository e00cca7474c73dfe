#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace atrium::metric {

/// How many corners a ring needs if it may leave the given one by `tolerance`: those of the coarsest ring, among the
/// given corners and as greedy choice finds it, that has all others within the tolerance of its sides. It begins at the
/// corner that turns most. A circle of radius r becomes a chain of chords with a sagitta of at most the tolerance.
/// Never fewer than three.
std::size_t fewest_corners(const std::vector<Eigen::Vector3d>& ring, double tolerance);

}  // namespace atrium::metric
