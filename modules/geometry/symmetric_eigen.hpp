#pragma once
#include <Eigen/Core>

namespace atrium {

/// Eigenvalues, ascending, and eigenvectors of a symmetric matrix.
struct SymmetricEigen {
  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;  ///< columns of unit length, in the order of the values
};

/// By QR iterations (Eigen's SelfAdjointEigenSolver, compiled here alone: it costs each file that calls it two
/// seconds). Reads the lower triangle; NaN gives NaN.
SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix);

}  // namespace atrium
