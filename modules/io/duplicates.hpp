#pragma once
#include <Eigen/Core>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::io {

/// Share of the points that lie exactly where an earlier one does, 0 … 1. Counted over all points at some ten thousand
/// places, which are chosen by a hash of the place: the share of the whole cloud to about a hundredth.
double duplicate_share(const std::vector<Eigen::Vector3f>& points, const Context& context);

/// In how many places the points lie, if in fewer than a tenth of their number and fewer than 1000; else 0.
std::size_t few_places(const std::vector<Eigen::Vector3f>& points);

}  // namespace atrium::io
