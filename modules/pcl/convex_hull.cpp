#include "modules/pcl/convex_hull.hpp"

#include <fmt/format.h>
#include <pcl/surface/convex_hull.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "modules/geometry/moments.hpp"
#include "modules/object/surface.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {
namespace {

/// Whether the points lie in one plane, on a line or in one place: Qhull then prints a page of advice.
bool is_flat(const std::vector<Eigen::Vector3f>& points) {
  constexpr double flat = 1e-5;  // thickness over length, both as standard deviations: some digits of a float
  Moments moments;
  for (const auto& p : points) moments.add((p - points.front()).cast<double>());
  const auto variances = fit_plane(moments).variances;
  return !(std::sqrt(std::max(0.0, variances[0])) > flat * std::sqrt(variances[2]));
}

/// Appends the hull of the points; false where they have none.
bool add_hull(const std::vector<Eigen::Vector3f>& points, object::RawSurface& surface) {
  if (points.size() < object::least_points || is_flat(points)) return false;
  pcl::ConvexHull<pcl::PointXYZ> hull;
  hull.setInputCloud(to_pcl<pcl::PointXYZ>(points));
  hull.setDimension(3);
  pcl::PointCloud<pcl::PointXYZ> corners;
  std::vector<pcl::Vertices> polygons;
  hull.reconstruct(corners, polygons);
  if (corners.empty() || polygons.size() < 4) return false;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const auto& c : corners) middle += Eigen::Vector3f(c.getVector3fMap()) / static_cast<float>(corners.size());
  const auto first = static_cast<std::uint32_t>(surface.vertices.size());
  for (const auto& c : corners) surface.vertices.emplace_back(c.getVector3fMap());
  for (auto triangle : triangles_of(polygons)) {
    for (auto& v : triangle) v += first;
    const Eigen::Vector3f& a = surface.vertices[triangle[0]];
    const Eigen::Vector3f normal =
        (surface.vertices[triangle[1]] - a).cross(surface.vertices[triangle[2]] - a);  // Qhull leaves its side open
    if (normal.dot(a - middle) < 0) std::swap(triangle[1], triangle[2]);
    surface.triangles.push_back(triangle);
  }
  return true;
}

}  // namespace

ConvexHull::Out ConvexHull::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  Out out;
  out.mesh.origin = cloud.origin;
  if (cloud.size() == 0) return out;
  if (params.by_label && cloud.labels.empty())
    throw Error("the cloud has no labels", "put pcl.clusters before this node, or leave by_label out");
  std::map<std::int32_t, std::vector<Eigen::Vector3f>> groups;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    groups[params.by_label ? cloud.labels[i] : 0].push_back(cloud.points[i]);
  object::RawSurface surface;
  std::size_t without = 0;
  for (const auto& [label, points] : groups) without += add_hull(points, surface) ? 0 : 1;
  if (without > 0)
    context.info(fmt::format("{} of {} groups of points lie in one plane or are fewer than {}: they have no hull",
                             without, groups.size(), object::least_points));
  out.mesh = object::finished(surface, cloud, std::numeric_limits<float>::infinity(), context);
  return out;
}

}  // namespace atrium::pcl_nodes
