#include "modules/pcl/clusters.hpp"

#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <limits>

#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {

Clusters::Out Clusters::run(const In& in, const Params& params) {
  const Cloud& cloud = *in.cloud;
  if (cloud.size() == 0) return {cloud};
  const auto points = to_pcl<pcl::PointXYZ>(cloud);
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(points);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(points);
  extraction.setSearchMethod(tree);
  extraction.setClusterTolerance(params.tolerance);
  extraction.setMinClusterSize(static_cast<pcl::uindex_t>(params.min_points));
  extraction.setMaxClusterSize(params.max_points > 0 ? static_cast<pcl::uindex_t>(params.max_points)
                                                     : std::numeric_limits<pcl::uindex_t>::max());
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  // PCL sorts them by size, but not stably.
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.indices.size() != b.indices.size() ? a.indices.size() > b.indices.size()
                                                : a.indices.front() < b.indices.front();
  });
  std::vector<std::int32_t> labels(cloud.size(), -1);
  for (std::size_t k = 0; k < found.size(); ++k)
    for (const auto i : found[k].indices) labels[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(k);
  std::vector<std::uint32_t> kept;
  kept.reserve(cloud.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] >= 0) kept.push_back(static_cast<std::uint32_t>(i));
  Out out{select(cloud, kept)};
  out.cloud.labels.clear();
  out.cloud.labels.reserve(kept.size());
  for (const auto i : kept) out.cloud.labels.push_back(labels[i]);
  out.removed = static_cast<std::int64_t>(cloud.size() - kept.size());
  out.clusters = static_cast<std::int64_t>(found.size());
  return out;
}

}  // namespace atrium::pcl_nodes
