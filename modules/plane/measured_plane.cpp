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
  constexpr double least_square = 0.1;
  const auto count = static_cast<double>(primitive.inliers.size());
  result.square = std::max(least_square, 2 * std::sqrt(box.volume() / count));
  result.columns = static_cast<int>(box.sizes().x() / result.square) + 1;
  result.rows = static_cast<int>(box.sizes().y() / result.square) + 1;
  result.squares.assign(static_cast<std::size_t>(result.columns) * static_cast<std::size_t>(result.rows), false);
  for (const auto i : primitive.inliers) {
    const Eigen::Vector3d p = cloud.points[i].cast<double>();
    const Eigen::Vector2d at = (Eigen::Vector2d(u.dot(p), v.dot(p)) - box.min()) / result.square;
    result.squares[static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(result.columns) +
                   static_cast<std::size_t>(at.x())] = true;
  }
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

double MeasuredPlane::share_over(const MeasuredPlane& other) const {
  if (columns == 0 || other.columns == 0) return 0;
  const auto along = [](const MeasuredPlane& m) -> Eigen::Vector3d {
    return (m.corners[1] - m.corners[0]).normalized();
  };
  const auto across = [](const MeasuredPlane& m) -> Eigen::Vector3d {
    return (m.corners[3] - m.corners[0]).normalized();
  };
  const Eigen::Vector3d u = along(*this), v = across(*this), other_u = along(other), other_v = across(other);
  std::size_t all = 0, over = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      if (!squares[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)])
        continue;
      ++all;
      const Eigen::Vector3d d = corners[0] + (x + 0.5) * square * u + (y + 0.5) * square * v - other.corners[0];
      const auto column = static_cast<int>(std::floor(other_u.dot(d) / other.square));
      const auto row = static_cast<int>(std::floor(other_v.dot(d) / other.square));
      if (column < 0 || row < 0 || column >= other.columns || row >= other.rows) continue;
      over += other.squares[static_cast<std::size_t>(row) * static_cast<std::size_t>(other.columns) +
                            static_cast<std::size_t>(column)]
                  ? 1
                  : 0;
    }
  return all == 0 ? 0 : static_cast<double>(over) / static_cast<double>(all);
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
