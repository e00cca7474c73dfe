#pragma once
#include <Eigen/Core>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/point_grid.hpp"
#include "modules/geometry/point_tree.hpp"
#include "modules/geometry/triangle_tree.hpp"

namespace atrium::metric {

/// Exact distance of every point of the grid to the nearest triangle, in the grid's order. Each cell first finds the
/// triangles that can be nearest to any of its points; where those are few, only they are looked at.
std::vector<float> distances_to_mesh(const PointGrid& grid, const TriangleTree& tree, const Context& context);

/// Nearest points of a gridded cloud: a tree over the middles of the cells, then the points of the few cells that come
/// into question.
class CloudSearch {
 public:
  CloudSearch(const PointGrid& grid, const Context& context);
  /// Exact distance to the nearest point.
  double nearest(const Eigen::Vector3d& position) const;

 private:
  struct Bucket {
    Eigen::Vector3f low, high;  ///< tight around its points
    std::uint32_t begin, end;
  };
  const PointGrid& grid_;
  std::vector<Bucket> buckets_;
  PointTree middles_;
  float reach_ = 0;  ///< of the largest bucket from its middle
};

}  // namespace atrium::metric
