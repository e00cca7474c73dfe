#include "modules/pcl/outliers.hpp"

#include <fmt/format.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/statistical_outlier_removal.h>

#include "graph/api/text.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {
namespace {

pcl::Indices statistical(const Cloud& cloud, const Outliers::Params& params) {
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(to_pcl<pcl::PointXYZ>(cloud));
  filter.setMeanK(static_cast<int>(params.neighbours));
  filter.setStddevMulThresh(params.deviations);
  pcl::Indices kept;
  filter.filter(kept);
  return kept;
}

pcl::Indices within_radius(const Cloud& cloud, const Outliers::Params& params) {
  pcl::RadiusOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(to_pcl<pcl::PointXYZ>(cloud));
  filter.setRadiusSearch(params.radius);
  filter.setMinNeighborsInRadius(static_cast<int>(params.min_neighbours));
  pcl::Indices kept;
  filter.filter(kept);
  return kept;
}

}  // namespace

Outliers::Out Outliers::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  const bool by_statistics = params.method == OutlierMethod::statistical;
  if (cloud.size() <= (by_statistics ? static_cast<std::size_t>(params.neighbours) : 0)) {
    if (cloud.size() > 0)
      context.warn(fmt::format("{} too few to find outliers by {} neighbours",
                               counted(cloud.size(), "point is", "points are"), params.neighbours));
    return {cloud, 0};
  }
  Out out{select(cloud, from_pcl(by_statistics ? statistical(cloud, params) : within_radius(cloud, params)))};
  out.removed = static_cast<std::int64_t>(cloud.size() - out.cloud.size());
  return out;
}

}  // namespace atrium::pcl_nodes
