#include "modules/object/greedy.hpp"

#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "modules/object/pcl_surfaces.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::object {
namespace {

/// Indices of the points without those that stand where an earlier one does, ascending.
std::vector<std::uint32_t> distinct(const Cloud& cloud) {
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const auto& p = cloud.points[i];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t l, std::uint32_t r) { return std::make_pair(key(l), l) < std::make_pair(key(r), r); });
  order.erase(
      std::unique(order.begin(), order.end(), [&](std::uint32_t l, std::uint32_t r) { return key(l) == key(r); }),
      order.end());
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace

RawSurface greedy_surface(const Cloud& cloud, const GreedySettings& settings) {
  constexpr double radians = std::numbers::pi / 180;
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
  greedy.setSearchRadius(settings.search_radius);
  greedy.setMu(settings.reach);
  greedy.setMaximumNearestNeighbors(
      static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(settings.max_neighbours), cloud.size())));
  greedy.setMaximumSurfaceAngle(settings.max_surface_angle * radians);
  greedy.setMinimumAngle(settings.min_angle * radians);
  greedy.setMaximumAngle(settings.max_angle * radians);
  greedy.setNormalConsistency(settings.normal_consistency);
  greedy.setConsistentVertexOrdering(true);
  const auto points = pcl_nodes::to_pcl<pcl::PointNormal>(cloud);
  pcl::search::KdTree<pcl::PointNormal>::Ptr tree(new pcl::search::KdTree<pcl::PointNormal>);
  tree->setInputCloud(points);
  greedy.setInputCloud(points);
  greedy.setSearchMethod(tree);
  std::vector<pcl::Vertices> polygons;
  greedy.reconstruct(polygons);

  RawSurface surface;
  surface.vertices = cloud.points;
  surface.triangles = pcl_nodes::triangles_of(polygons);
  return surface;
}

Greedy::Out Greedy::run(const In& in, const Params& params, Context& context) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  if (!is_surface(*in.cloud, context)) return out;
  const Cloud cloud = select(*in.cloud, distinct(*in.cloud));
  if (!is_surface(cloud, context)) return out;
  GreedySettings settings;
  settings.search_radius = params.search_radius;
  settings.reach = params.reach;
  settings.max_neighbours = params.max_neighbours;
  settings.max_surface_angle = params.max_surface_angle;
  settings.min_angle = params.min_angle;
  settings.max_angle = params.max_angle;
  out.mesh = finished(greedy_surface(cloud, settings), cloud, std::numeric_limits<float>::infinity(), context);
  return out;
}

}  // namespace atrium::object
