#include "modules/pcl/ransac.hpp"

#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "modules/pcl/pcl_cloud.hpp"
#include "modules/pcl/plane_regions.hpp"

namespace atrium::pcl_nodes {
namespace {

using PlainSearch = pcl::SACSegmentation<pcl::PointXYZ>;
using NormalSearch = pcl::SACSegmentationFromNormals<pcl::PointXYZ, pcl::Normal>;

std::unique_ptr<PlainSearch> search_of(const Cloud& cloud, const Ransac::Params& params) {
  std::unique_ptr<PlainSearch> search;
  if (params.normal_weight > 0) {
    auto with_normals = std::make_unique<NormalSearch>();
    with_normals->setInputNormals(normals_to_pcl(cloud));
    with_normals->setNormalDistanceWeight(params.normal_weight);
    with_normals->setModelType(pcl::SACMODEL_NORMAL_PLANE);
    search = std::move(with_normals);
  } else {
    search = std::make_unique<PlainSearch>();
    search->setModelType(pcl::SACMODEL_PLANE);
  }
  search->setInputCloud(to_pcl<pcl::PointXYZ>(cloud));
  search->setMethodType(pcl::SAC_RANSAC);
  search->setDistanceThreshold(params.distance);
  search->setProbability(1 - params.probability);
  search->setMaxIterations(params.max_iterations);
  return search;
}

/// All indices, shuffled by the run's seed (Fisher and Yates).
pcl::Indices shuffled(std::size_t size, Context& context) {
  pcl::Indices order(size);
  std::iota(order.begin(), order.end(), 0);
  Random random = context.random();
  for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
  return order;
}

}  // namespace

Ransac::Out Ransac::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  check_planes_input(cloud, params.normal_weight > 0);
  const std::size_t min_points = least_points_of_plane(cloud, params.min_points);
  const auto search = search_of(cloud, params);
  const pcl::IndicesPtr left(new pcl::Indices(shuffled(cloud.size(), context)));
  std::vector<bool> taken(cloud.size(), false);
  std::vector<std::vector<std::uint32_t>> regions;
  while (left->size() >= min_points &&
         (params.max_planes == 0 || regions.size() < static_cast<std::size_t>(params.max_planes))) {
    context.check_cancelled();
    pcl::PointIndices inliers;
    pcl::ModelCoefficients coefficients;
    search->setIndices(left);
    search->segment(inliers, coefficients);
    if (inliers.indices.size() < min_points) break;
    for (const auto i : inliers.indices) taken[static_cast<std::size_t>(i)] = true;
    std::erase_if(*left, [&](pcl::index_t i) { return taken[static_cast<std::size_t>(i)]; });
    regions.push_back(from_pcl(inliers.indices));
  }
  return {fitted_planes(in.cloud, std::move(regions))};
}

}  // namespace atrium::pcl_nodes
