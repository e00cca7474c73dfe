#include "modules/object/greedy.hpp"

#include <pcl/console/print.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "modules/object/pcl_points.hpp"
#include "modules/object/surface.hpp"

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

RawSurface reconstruct(const Cloud& cloud, const Greedy::Params& params) {
  constexpr double radians = std::numbers::pi / 180;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
  greedy.setSearchRadius(params.search_radius);
  greedy.setMu(params.reach);
  greedy.setMaximumNearestNeighbors(
      static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(params.max_neighbours), cloud.size())));
  greedy.setMaximumSurfaceAngle(params.max_surface_angle * radians);
  greedy.setMinimumAngle(params.min_angle * radians);
  greedy.setMaximumAngle(params.max_angle * radians);
  greedy.setNormalConsistency(true);
  greedy.setConsistentVertexOrdering(true);
  const auto points = to_pcl(cloud);
  pcl::search::KdTree<pcl::PointNormal>::Ptr tree(new pcl::search::KdTree<pcl::PointNormal>);
  tree->setInputCloud(points);
  greedy.setInputCloud(points);
  greedy.setSearchMethod(tree);
  std::vector<pcl::Vertices> polygons;
  greedy.reconstruct(polygons);

  RawSurface surface;
  surface.vertices = cloud.points;
  for (const auto& polygon : polygons)
    if (polygon.vertices.size() == 3)
      surface.triangles.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                                   static_cast<std::uint32_t>(polygon.vertices[1]),
                                   static_cast<std::uint32_t>(polygon.vertices[2])});
  return surface;
}

}  // namespace

Greedy::Out Greedy::run(const In& in, const Params& params, Context& context) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  if (!is_surface(*in.cloud, context)) return out;
  const Cloud cloud = select(*in.cloud, distinct(*in.cloud));
  if (!is_surface(cloud, context)) return out;
  out.mesh = finished(reconstruct(cloud, params), cloud, std::numeric_limits<float>::infinity(), context);
  return out;
}

}  // namespace atrium::object
