#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/point_tree.hpp"

namespace atrium::filter {

/// The mean distance of a cloud's points to their k nearest other points, 0 < k < points.size(). Exact, whatever the
/// density. Points of one leaf of a PointTree share a search: their neighbours are nearly the same. Keeps a reference
/// to the points.
class Spacing {
 public:
  Spacing(const std::vector<Eigen::Vector3f>& points, std::size_t k, const Context& context);

  /// Those of a number of points spread evenly over the tree's leaves, and so over the scene, metres: of all points (in
  /// no particular order) unless there are four times as many as wanted.
  std::vector<float> sample(std::size_t wanted, const Context& context) const;
  /// A mark for each point: 1 where it is at most `limit`. Most points need no search for it: who has k others within
  /// the limit is nearer to them in the mean.
  std::vector<std::uint8_t> at_most(double limit, const Context& context) const;

 private:
  const std::vector<Eigen::Vector3f>& points_;
  std::size_t k_;
  PointTree tree_;
};

}  // namespace atrium::filter
