#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "modules/types/plane_primitives.hpp"

namespace atrium {

/// Count, first and second moments of points, in double about a reference point that the caller chooses near them.
/// Adding is exact enough to fit planes over 10⁸ points when the reference is within some metres.
struct Moments {
  std::uint64_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  ///< Σ p pᵀ

  void add(const Eigen::Vector3d& p) {
    ++count;
    sum += p;
    products += p * p.transpose();
  }
  Moments& operator+=(const Moments& other) {
    count += other.count;
    sum += other.sum;
    products += other.products;
    return *this;
  }
  Eigen::Vector3d mean() const { return sum / static_cast<double>(count); }
  Eigen::Matrix3d covariance() const {
    const Eigen::Vector3d m = mean();
    return products / static_cast<double>(count) - m * m.transpose();
  }
};

/// A least-squares plane and the spread of its points.
struct PlaneFit {
  Plane plane;  ///< the sign of the normal is arbitrary (largest component positive)
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();  ///< along the principal axes, ascending; the first is residual²
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();   ///< columns, in the order of variances
};

/// Orthogonal least squares. Needs at least 3 points; fewer, or points in one place, give a plane of variances 0.
PlaneFit fit_plane(const Moments& moments);

}  // namespace atrium
