#include "modules/normal/local_plane.hpp"

namespace atrium::normal {

void neighbour_normals(const std::vector<Eigen::Vector3f>& points, std::size_t k,
                       const std::vector<std::uint32_t>& which, std::vector<Eigen::Vector3f>& normals,
                       const Context& context) {
  if (which.empty()) return;
  const PointTree tree(points, context);
  // All points are walked along the tree's curve, where the searches of neighbours share what they read.
  const bool all = which.size() == points.size();
  const std::vector<std::uint32_t>& walk = all ? tree.order() : which;
  context.parallel_for(
      walk.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour> scratch;
        for (std::size_t i = begin; i < end; ++i)
          normals[walk[i]] = normal_of_nearest(tree, points, points[walk[i]], k, scratch);
      },
      1024);
}

}  // namespace atrium::normal
