#include "modules/object/poisson.hpp"

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/poisson.h>

#include <algorithm>
#include <mutex>

#include "modules/object/surface.hpp"

namespace atrium::object {
namespace {

pcl::PointCloud<pcl::PointNormal>::Ptr to_pcl(const Cloud& cloud) {
  pcl::PointCloud<pcl::PointNormal>::Ptr result(new pcl::PointCloud<pcl::PointNormal>);
  result->resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    (*result)[i].getVector3fMap() = cloud.points[i];
    (*result)[i].getNormalVector3fMap() = cloud.normals[i];
  }
  return result;
}

RawSurface reconstruct(const Cloud& cloud, const Poisson::Params& params) {
  constexpr int coarsest = 5;  // PCL's default of min_depth
  // PCL's octree allocates nodes from one pool of the whole program.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::Poisson<pcl::PointNormal> poisson;
  const auto depth = static_cast<int>(params.depth);
  poisson.setDepth(depth);
  poisson.setMinDepth(std::min(coarsest, depth));
  poisson.setSolverDivide(std::max(coarsest, depth));
  poisson.setIsoDivide(std::max(coarsest, depth));
  poisson.setSamplesPerNode(static_cast<float>(params.samples_per_node));
  poisson.setPointWeight(static_cast<float>(params.point_weight));
  poisson.setThreads(1);
  poisson.setInputCloud(to_pcl(cloud));
  pcl::PointCloud<pcl::PointNormal> points;
  std::vector<pcl::Vertices> polygons;
  poisson.reconstruct(points, polygons);

  RawSurface surface;
  surface.vertices.reserve(points.size());
  for (const auto& p : points) surface.vertices.emplace_back(p.getVector3fMap());
  for (const auto& polygon : polygons)
    for (std::size_t k = 2; k < polygon.vertices.size(); ++k)
      surface.triangles.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                                   static_cast<std::uint32_t>(polygon.vertices[k - 1]),
                                   static_cast<std::uint32_t>(polygon.vertices[k])});
  return surface;
}

}  // namespace

Poisson::Out Poisson::run(const In& in, const Params& params, Context& context) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  if (is_surface(*in.cloud, context))
    out.mesh = finished(reconstruct(*in.cloud, params), *in.cloud, params.trim, context);
  return out;
}

}  // namespace atrium::object
