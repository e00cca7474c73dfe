#include "modules/plane/measured_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace atrium::plane {
namespace {

MeasuredPlane measure(const PlanePrimitive& primitive, const Cloud& cloud) {
  MeasuredPlane result;
  result.plane = primitive.plane;
  if (primitive.inliers.empty()) return result;
  for (const auto i : primitive.inliers) result.moments.add(cloud.points[i].cast<double>());
  const PlaneFit fit = fit_plane(result.moments);
  const Eigen::Vector3d& n = primitive.plane.normal;
  Eigen::Vector3d u = fit.axes.col(2) - n * n.dot(fit.axes.col(2));
  u = u.norm() > 1e-6 ? u.normalized() : n.unitOrthogonal();
  const Eigen::Vector3d v = n.cross(u);
  Eigen::AlignedBox2d box;
  for (const auto i : primitive.inliers) {
    const Eigen::Vector3d p = cloud.points[i].cast<double>();
    box.extend(Eigen::Vector2d(u.dot(p), v.dot(p)));
  }
  const Eigen::Vector3d base = -primitive.plane.offset * n;
  const auto corner = [&](double x, double y) -> Eigen::Vector3d { return base + u * x + v * y; };
  result.corners = {corner(box.min().x(), box.min().y()), corner(box.max().x(), box.min().y()),
                    corner(box.max().x(), box.max().y()), corner(box.min().x(), box.max().y())};
  return result;
}

}  // namespace

double MeasuredPlane::rms_to(const Plane& other) const {
  if (moments.count == 0) return 0;
  const double distance = other.signed_distance(moments.mean());
  const double spread = other.normal.dot(moments.covariance() * other.normal);
  return std::sqrt(distance * distance + std::max(0.0, spread));
}

double MeasuredPlane::reach_to(const Plane& other) const {
  double reach = 0;
  for (const auto& corner : corners) reach = std::max(reach, std::abs(other.signed_distance(corner)));
  return reach;
}

double MeasuredPlane::shared_area(const MeasuredPlane& other) const {
  const Eigen::Vector3d along = corners[1] - corners[0];
  const Eigen::Vector3d across = corners[3] - corners[0];
  const double sides = along.norm() * across.norm();
  if (sides <= 0) return 0;
  Eigen::AlignedBox2d box;
  for (const auto& corner : other.corners) {
    const Eigen::Vector3d d = corner - corners[0];
    box.extend(Eigen::Vector2d(along.dot(d) / along.squaredNorm(), across.dot(d) / across.squaredNorm()));
  }
  const Eigen::AlignedBox2d own(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  const Eigen::AlignedBox2d shared = own.intersection(box);
  return shared.isEmpty() ? 0 : shared.volume() * sides;
}

std::vector<MeasuredPlane> measure_planes(const PlanePrimitives& planes, const Context& context) {
  std::vector<MeasuredPlane> result(planes.primitives.size());
  context.parallel_for(
      result.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) result[i] = measure(planes.primitives[i], *planes.cloud);
      },
      1);
  return result;
}

double mean_residual(const std::vector<MeasuredPlane>& planes) {
  double sum = 0;
  double count = 0;
  for (const auto& plane : planes) {
    const auto points = static_cast<double>(plane.moments.count);
    sum += points * plane.rms_to(plane.plane);
    count += points;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace atrium::plane
