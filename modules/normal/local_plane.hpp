#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/point_tree.hpp"

namespace atrium::normal {

/// Count, first and second moments about some point nearby.
struct LocalMoments {
  double n = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(const Eigen::Vector3d& p) {
    n += 1;
    sum += p;
    xx += p.x() * p.x();
    xy += p.x() * p.y();
    xz += p.x() * p.z();
    yy += p.y() * p.y();
    yz += p.y() * p.z();
    zz += p.z() * p.z();
  }
  /// Adds moments about a point that lies `offset` from this one's.
  void add_shifted(const LocalMoments& other, const Eigen::Vector3d& offset);
  /// Mean square distance of the points to the plane normal · x + offset = 0, both about the same point.
  double mean_square_distance(const Eigen::Vector3d& normal, double offset) const;
};

/// The plane normal · x + offset = 0 of least squares, about the moments' point.
struct LocalPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;
  double residual = 0;  ///< mean square distance of its points, metres²
  double n = 0;         ///< how many they were; 0: no plane (too few points, or all on a line)
};

constexpr double min_points = 5;

/// No plane (n = 0) with fewer than `least` points, or if they lie on a line: as thin along their second axis as along
/// the first.
LocalPlane fit(const LocalMoments& moments, double least = min_points);

/// The eigenvector of the least eigenvalue of a symmetric positive matrix, unit and finite whatever the matrix;
/// eigenvalues ascending.
Eigen::Vector3d least_axis(const Eigen::Matrix3d& matrix, Eigen::Vector3d& eigenvalues);

/// The normal of the k nearest points: for any k and cloud of three points or more there is one.
Eigen::Vector3f normal_of_nearest(const PointTree& tree, const std::vector<Eigen::Vector3f>& points,
                                  const Eigen::Vector3f& position, std::size_t k, std::vector<Neighbour>& scratch);

/// Normals by the three methods. `missing` gets, ascending, the points whose neighbourhood gives no plane.
std::vector<Eigen::Vector3f> voxel_normals(const std::vector<Eigen::Vector3f>& points, double voxel,
                                           std::vector<std::uint32_t>& missing, const Context& context);
std::vector<Eigen::Vector3f> radius_normals(const std::vector<Eigen::Vector3f>& points, double radius,
                                            std::vector<std::uint32_t>& missing, const Context& context);
/// Of the points `which` only; `normals` has all.
void neighbour_normals(const std::vector<Eigen::Vector3f>& points, std::size_t k,
                       const std::vector<std::uint32_t>& which, std::vector<Eigen::Vector3f>& normals,
                       const Context& context);

}  // namespace atrium::normal
