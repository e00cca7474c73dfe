#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>

namespace atrium::baseline {

/// Weighted sum of squared distances to planes (Garland and Heckbert 1997): xᵀ A x + 2 bᵀ x + c.
struct QuadricError {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< of A, which is symmetric
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0;
  double weight = 0;

  void add(const Eigen::Vector3d& normal, double offset, double w) {
    const Eigen::Vector3d n = w * normal;
    xx += n.x() * normal.x();
    xy += n.x() * normal.y();
    xz += n.x() * normal.z();
    yy += n.y() * normal.y();
    yz += n.y() * normal.z();
    zz += n.z() * normal.z();
    b += offset * n;
    c += w * offset * offset;
    weight += w;
  }
  QuadricError& operator+=(const QuadricError& other) {
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    b += other.b;
    c += other.c;
    weight += other.weight;
    return *this;
  }
  Eigen::Matrix3d a() const {
    Eigen::Matrix3d full;
    full << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return full;
  }
  Eigen::Vector3d a_times(const Eigen::Vector3d& x) const {
    return {xx * x.x() + xy * x.y() + xz * x.z(), xy * x.x() + yy * x.y() + yz * x.z(),
            xz * x.x() + yz * x.y() + zz * x.z()};
  }
  double at(const Eigen::Vector3d& x) const { return std::max(0.0, x.dot(a_times(x) + 2 * b) + c); }
  /// The place of least error; where the planes do not tell, that nearest to `near`. They do not if the directions
  /// that they leave open have less than `pull` of the weight (proximal point method, two steps).
  Eigen::Vector3d least(const Eigen::Vector3d& near, double pull) const {
    const Eigen::Matrix3d inverse = (a() + pull * weight * Eigen::Matrix3d::Identity()).inverse();
    const Eigen::Vector3d first = near - inverse * (a_times(near) + b);
    return first - inverse * (a_times(first) + b);
  }
};

}  // namespace atrium::baseline
