#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>

namespace atrium::baseline {

/// Weighted sum of squared distances to planes (Garland and Heckbert 1997): xᵀ A x + 2 bᵀ x + c.
struct QuadricError {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0;
  double weight = 0;

  void add(const Eigen::Vector3d& normal, double offset, double w) {
    a += w * normal * normal.transpose();
    b += w * offset * normal;
    c += w * offset * offset;
    weight += w;
  }
  QuadricError& operator+=(const QuadricError& other) {
    a += other.a;
    b += other.b;
    c += other.c;
    weight += other.weight;
    return *this;
  }
  double at(const Eigen::Vector3d& x) const { return std::max(0.0, x.dot(a * x) + 2 * b.dot(x) + c); }
  /// The place of least error; where the planes do not tell, that nearest to `near`. They do not if the directions
  /// that they leave open have less than `pull` of the weight (proximal point method, two steps).
  Eigen::Vector3d least(const Eigen::Vector3d& near, double pull) const {
    const Eigen::Matrix3d inverse = (a + pull * weight * Eigen::Matrix3d::Identity()).inverse();
    const Eigen::Vector3d first = near - inverse * (a * near + b);
    return first - inverse * (a * first + b);
  }
};

}  // namespace atrium::baseline
