#include "modules/geometry/polygon_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/geometry/polygon.hpp"

namespace atrium {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

/// Is x, a point of the polygon's plane, in the polygon (or above or below it)?
bool is_over(const Corners& polygon, const Eigen::Vector3d& normal, const Eigen::Vector3d& x) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (normal.dot(edge.cross(x - polygon[i])) < 0) return false;
  }
  return true;
}

/// Least distance from a segment to the inside of a polygon, as far as it is not reached at the polygon's rim: an end
/// that lies over the polygon, or a crossing. Infinity where there is neither.
double distance_to_inside(const Eigen::Vector3d& s0, const Eigen::Vector3d& s1, const Corners& polygon,
                          const Eigen::Vector3d& normal) {
  double best = std::numeric_limits<double>::infinity();
  const double h0 = normal.dot(s0 - polygon[0]);
  const double h1 = normal.dot(s1 - polygon[0]);
  if (is_over(polygon, normal, s0)) best = std::min(best, std::abs(h0));
  if (is_over(polygon, normal, s1)) best = std::min(best, std::abs(h1));
  if (h0 * h1 < 0 && is_over(polygon, normal, s0 + (s1 - s0) * (h0 / (h0 - h1)))) return 0;
  return best;
}

double distance_to_inside(const Corners& edges, const Corners& polygon) {
  const Eigen::Vector3d normal = vector_area(polygon).normalized();
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < edges.size(); ++i)
    best = std::min(best, distance_to_inside(edges[i], edges[(i + 1) % edges.size()], polygon, normal));
  return best;
}

}  // namespace

double segment_distance(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1, const Eigen::Vector3d& b0,
                        const Eigen::Vector3d& b1) {
  const Eigen::Vector3d da = a1 - a0;
  const Eigen::Vector3d db = b1 - b0;
  const Eigen::Vector3d r = a0 - b0;
  const double aa = da.squaredNorm();
  const double bb = db.squaredNorm();
  const double ab = da.dot(db);
  const double ar = da.dot(r);
  const double br = db.dot(r);
  const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  double s = 0;
  if (const double d = aa * bb - ab * ab; d > 1e-12 * aa * bb) s = clamp((ab * br - ar * bb) / d);
  double t = bb > 0 ? (ab * s + br) / bb : 0;
  if (t < 0 || t > 1) {
    t = clamp(t);
    s = aa > 0 ? clamp((ab * t - ar) / aa) : 0;
  } else if (bb == 0) {
    s = aa > 0 ? clamp(-ar / aa) : 0;
  }
  return (r + da * s - db * t).norm();
}

double segment_polygon_distance(const Eigen::Vector3d& s0, const Eigen::Vector3d& s1, const Corners& polygon) {
  double best = distance_to_inside(s0, s1, polygon, vector_area(polygon).normalized());
  for (std::size_t j = 0; j < polygon.size(); ++j)
    best = std::min(best, segment_distance(s0, s1, polygon[j], polygon[(j + 1) % polygon.size()]));
  return best;
}

double polygon_distance(const Corners& a, const Corners& b) {
  // The nearest pair of points has one on a rim: of rim and rim, or of a rim's corner or crossing and an inside.
  double best = std::min(distance_to_inside(a, b), distance_to_inside(b, a));
  for (std::size_t i = 0; i < a.size() && best > 0; ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      best = std::min(best, segment_distance(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]));
  return best;
}

}  // namespace atrium
