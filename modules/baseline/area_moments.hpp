#pragma once
#include <Eigen/Geometry>
#include <array>

#include "modules/geometry/symmetric_eigen.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::baseline {

/// Area and first and second moments of triangles, for planes of least squares over a surface instead of its vertices.
struct AreaMoments {
  double area = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();  ///< area vectors

  void add(const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]) / 2;
    const double size = normal.norm();
    const Eigen::Vector3d total = corners[0] + corners[1] + corners[2];
    area += size;
    sum += size / 3 * total;
    Eigen::Matrix3d squares = total * total.transpose();
    for (const auto& c : corners) squares += c * c.transpose();
    products += size / 12 * squares;
    normals += normal;
  }
  AreaMoments& operator+=(const AreaMoments& other) {
    area += other.area;
    sum += other.sum;
    products += other.products;
    normals += other.normals;
    return *this;
  }
  /// Mean square distance to a plane through mean().
  double mean_square(const Eigen::Vector3d& normal, double offset) const {
    return (normal.dot(products * normal) + 2 * offset * normal.dot(sum)) / area + offset * offset;
  }
  /// The plane of least squares, on the side of the area vectors.
  Plane plane() const {
    const Eigen::Vector3d mean = sum / area;
    Plane result;
    result.normal = symmetric_eigen(products / area - mean * mean.transpose()).vectors.col(0);
    if (result.normal.dot(normals) < 0) result.normal = -result.normal;
    result.offset = -result.normal.dot(mean);
    return result;
  }
};

}  // namespace atrium::baseline
