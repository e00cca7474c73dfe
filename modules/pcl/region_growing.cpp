#include "modules/pcl/region_growing.hpp"

#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>

#include <limits>
#include <numbers>

#include "modules/pcl/pcl_cloud.hpp"
#include "modules/pcl/plane_regions.hpp"

namespace atrium::pcl_nodes {

RegionGrowing::Out RegionGrowing::run(const In& in, const Params& params) {
  const Cloud& cloud = *in.cloud;
  check_planes_input(cloud, true);
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(to_pcl<pcl::PointXYZ>(cloud));
  growing.setInputNormals(normals_to_pcl(cloud));
  growing.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  growing.setNumberOfNeighbours(static_cast<unsigned>(params.neighbours));
  growing.setMinClusterSize(static_cast<int>(least_points_of_plane(cloud, params.min_points)));
  growing.setMaxClusterSize(std::numeric_limits<int>::max());
  growing.setSmoothModeFlag(false);     // against the region's first normal, not the point before's
  growing.setResidualTestFlag(true);    // before the next one: PCL wants one of the two tests on
  growing.setCurvatureTestFlag(false);  // our clouds do not carry curvature
  growing.setSmoothnessThreshold(static_cast<float>(params.angle * std::numbers::pi / 180));
  growing.setResidualThreshold(static_cast<float>(params.distance));
  std::vector<pcl::PointIndices> clusters;
  growing.extract(clusters);
  std::vector<std::vector<std::uint32_t>> regions;
  regions.reserve(clusters.size());
  for (const auto& cluster : clusters) regions.push_back(from_pcl(cluster.indices));
  Out out{fitted_planes(in.cloud, std::move(regions))};
  auto& primitives = out.planes.primitives;
  if (params.max_planes > 0 && primitives.size() > static_cast<std::size_t>(params.max_planes))
    primitives.resize(static_cast<std::size_t>(params.max_planes));
  return out;
}

}  // namespace atrium::pcl_nodes
