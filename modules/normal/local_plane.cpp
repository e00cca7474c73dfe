#include "modules/normal/local_plane.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/symmetric_eigen.hpp"

namespace atrium::normal {

void LocalMoments::add_shifted(const LocalMoments& other, const Eigen::Vector3d& offset) {
  const Eigen::Vector3d& d = offset;
  const Eigen::Vector3d& s = other.sum;
  n += other.n;
  sum += s + other.n * d;
  xx += other.xx + (2 * s.x() + other.n * d.x()) * d.x();
  yy += other.yy + (2 * s.y() + other.n * d.y()) * d.y();
  zz += other.zz + (2 * s.z() + other.n * d.z()) * d.z();
  xy += other.xy + s.x() * d.y() + s.y() * d.x() + other.n * d.x() * d.y();
  xz += other.xz + s.x() * d.z() + s.z() * d.x() + other.n * d.x() * d.z();
  yz += other.yz + s.y() * d.z() + s.z() * d.y() + other.n * d.y() * d.z();
}

double LocalMoments::mean_square_distance(const Eigen::Vector3d& normal, double offset) const {
  const Eigen::Vector3d& a = normal;
  const double square = xx * a.x() * a.x() + yy * a.y() * a.y() + zz * a.z() * a.z() +
                        2 * (xy * a.x() * a.y() + xz * a.x() * a.z() + yz * a.y() * a.z());
  return std::max(0.0, (square + 2 * offset * a.dot(sum)) / n + offset * offset);
}

Eigen::Vector3d least_axis(const Eigen::Matrix3d& matrix, Eigen::Vector3d& eigenvalues) {
  // The roots of the characteristic polynomial by trigonometry (Smith, "Eigenvalues of a symmetric 3 × 3 matrix",
  // 1961).
  const double mean = matrix.trace() / 3;
  const Eigen::Matrix3d centred = matrix - mean * Eigen::Matrix3d::Identity();
  const double spread = std::sqrt(centred.squaredNorm() / 6);
  if (spread > 0) {
    const double r = std::clamp((centred / spread).determinant() / 2, -1.0, 1.0);
    const double angle = std::acos(r) / 3;
    const double top = mean + 2 * spread * std::cos(angle);
    const double low = mean + 2 * spread * std::cos(angle + 2 * std::numbers::pi / 3);
    eigenvalues = {std::max(low, 0.0), std::max(3 * mean - top - low, 0.0), top};
    const Eigen::Matrix3d m = matrix - low * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d candidates[3] = {m.col(0).cross(m.col(1)), m.col(0).cross(m.col(2)),
                                           m.col(1).cross(m.col(2))};
    const Eigen::Vector3d* best = std::max_element(
        candidates, candidates + 3,
        [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
    const double length = best->norm();
    if (length > 1e-6 * top * top) return *best / length;
  }
  // Two or three equal eigenvalues: any vector of their space will do, but it must be a good one.
  const SymmetricEigen principal = symmetric_eigen(matrix);
  eigenvalues = principal.values.cwiseMax(0.0);
  const Eigen::Vector3d axis = principal.vectors.col(0);
  const double length = axis.norm();
  return std::isfinite(length) && length > 0.5 ? Eigen::Vector3d(axis / length) : Eigen::Vector3d::UnitZ();
}

LocalPlane fit(const LocalMoments& moments, double least) {
  LocalPlane plane;
  if (moments.n < least) return plane;
  const Eigen::Vector3d mean = moments.sum / moments.n;
  Eigen::Matrix3d covariance;
  covariance << moments.xx, moments.xy, moments.xz, moments.xy, moments.yy, moments.yz, moments.xz, moments.yz,
      moments.zz;
  covariance = covariance / moments.n - mean * mean.transpose();
  Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();
  plane.normal = least_axis(covariance, eigenvalues);
  plane.offset = -plane.normal.dot(mean);
  plane.residual = eigenvalues[0];
  const bool line = eigenvalues[1] < 1e-4 * eigenvalues[2] || eigenvalues[2] < 1e-12;
  plane.n = line ? 0 : moments.n;
  return plane;
}

Eigen::Vector3f normal_of_nearest(const PointTree& tree, const std::vector<Eigen::Vector3f>& points,
                                  const Eigen::Vector3f& position, std::size_t k, std::vector<Neighbour>& scratch) {
  tree.k_nearest(position, k, scratch);
  const Eigen::Vector3d centre = position.cast<double>();
  LocalMoments moments;
  for (const auto& n : scratch) moments.add(points[n.index].cast<double>() - centre);
  return fit(moments, 3).normal.cast<float>().normalized();
}

}  // namespace atrium::normal
