#include "modules/object/poisson.hpp"

#include <pcl/surface/poisson.h>

#include <algorithm>
#include <mutex>

#include "modules/object/pcl_surfaces.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::object {

RawSurface poisson_surface(const Cloud& cloud, const PoissonSettings& settings) {
  constexpr int coarsest = 5;  // levels that are solved as one: PCL's default, or its `min depth` were above the depth
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setInputCloud(pcl_nodes::to_pcl<pcl::PointNormal>(cloud));
  poisson.setDepth(settings.depth);
  poisson.setMinDepth(std::min(coarsest, settings.depth));
  poisson.setSolverDivide(std::max(coarsest, settings.depth));
  poisson.setIsoDivide(std::max(coarsest, settings.depth));
  poisson.setSamplesPerNode(static_cast<float>(settings.samples_per_node));
  poisson.setPointWeight(static_cast<float>(settings.point_weight));
  poisson.setScale(static_cast<float>(settings.scale));
  poisson.setConfidence(settings.confidence);
  poisson.setThreads(1);
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  poisson.reconstruct(vertices, polygons);
  RawSurface surface;
  surface.vertices.reserve(vertices.size());
  for (const auto& v : vertices) surface.vertices.emplace_back(v.getVector3fMap());
  surface.triangles = pcl_nodes::triangles_of(polygons);
  return surface;
}

Poisson::Out Poisson::run(const In& in, const Params& params, Context& context) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  if (!is_surface(*in.cloud, context)) return out;
  PoissonSettings settings;
  settings.depth = static_cast<int>(params.depth);
  settings.samples_per_node = params.samples_per_node;
  settings.point_weight = params.point_weight;
  out.mesh = finished(poisson_surface(*in.cloud, settings), *in.cloud, params.trim, context);
  return out;
}

}  // namespace atrium::object
