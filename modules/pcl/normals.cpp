#include "modules/pcl/normals.hpp"

#include <fmt/format.h>
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>

#include <atomic>
#include <numeric>

#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {
namespace {

/// On the side of `before`; without that, with a positive largest component.
Eigen::Vector3f turned(const Eigen::Vector3f& normal, const Eigen::Vector3f* before) {
  Eigen::Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  const float side = before == nullptr ? normal[largest] : normal.dot(*before);
  return side < 0 ? Eigen::Vector3f(-normal) : normal;
}

}  // namespace

Normals::Out Normals::run(const In& in, const Params& params, Context& context) {
  Out out{*in.cloud};
  if (in.cloud->size() == 0) return out;
  const auto points = to_pcl<pcl::PointXYZ>(*in.cloud);
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>(false));
  tree->setInputCloud(points);
  if (!in.cloud->has_normals()) out.cloud.normals.assign(points->size(), Eigen::Vector3f::UnitZ());
  std::atomic<std::size_t> missing = 0;
  context.parallel_for(points->size(), [&](std::size_t begin, std::size_t end) {
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    const pcl::IndicesPtr indices(new pcl::Indices(end - begin));
    std::iota(indices->begin(), indices->end(), static_cast<pcl::index_t>(begin));
    estimation.setInputCloud(points);
    estimation.setIndices(indices);
    estimation.setSearchMethod(tree);
    if (params.method == Neighbourhood::radius)
      estimation.setRadiusSearch(params.radius);
    else
      estimation.setKSearch(static_cast<int>(params.neighbours));
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute(normals);
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f normal = normals[i - begin].getNormalVector3fMap();
      if (normal.allFinite() && normal.norm() > 0.5F)
        out.cloud.normals[i] = turned(normal.normalized(), in.cloud->has_normals() ? &in.cloud->normals[i] : nullptr);
      else
        ++missing;
    }
  });
  if (missing > 0)
    context.warn(fmt::format("{} of {} points have fewer than three neighbours: they keep their normals, or get +z",
                             missing.load(), points->size()));
  return out;
}

}  // namespace atrium::pcl_nodes
