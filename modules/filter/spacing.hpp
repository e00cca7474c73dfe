#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::filter {

/// Each point's mean distance to its k nearest other points, metres; 0 < k < points.size(). Exact, whatever the
/// density. Points of one leaf of a PointTree share a search: their neighbours are nearly the same.
std::vector<float> mean_distances(const std::vector<Eigen::Vector3f>& points, std::size_t k, const Context& context);

}  // namespace atrium::filter
