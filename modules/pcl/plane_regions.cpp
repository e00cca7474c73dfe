#include "modules/pcl/plane_regions.hpp"

#include <algorithm>
#include <string>

#include "graph/api/error.hpp"
#include "modules/plane/assignment.hpp"

namespace atrium::pcl_nodes {

namespace {

/// Up; of an upright plane to +y, else to +x.
const Eigen::Vector3d default_side(0.01, 0.1, 1);

}  // namespace

void check_planes_input(const Cloud& cloud, bool normals) {
  if (cloud.size() < 3)
    throw Error("a plane needs at least 3 points, the cloud has " + std::to_string(cloud.size()),
                "look at what the nodes before this one have filtered away");
  if (normals && !cloud.has_normals())
    throw Error("the cloud has no normals", "put pcl.normals or normal.estimate before this node");
}

std::size_t least_points_of_plane(const Cloud& cloud, int asked) {
  if (asked > 0) return static_cast<std::size_t>(std::max(3, asked));
  return std::max<std::size_t>(50, cloud.size() / 2000);
}

PlanePrimitives fitted_planes(const std::shared_ptr<const Cloud>& cloud,
                              std::vector<std::vector<std::uint32_t>> regions) {
  PlanePrimitives result;
  result.cloud = cloud;
  result.primitives.reserve(regions.size());
  for (auto& region : regions) {
    std::sort(region.begin(), region.end());
    result.primitives.push_back(plane::fit_primitive(*cloud, std::move(region), default_side));
  }
  std::stable_sort(result.primitives.begin(), result.primitives.end(),
                   [](const auto& a, const auto& b) { return a.inliers.size() > b.inliers.size(); });
  return result;
}

}  // namespace atrium::pcl_nodes
