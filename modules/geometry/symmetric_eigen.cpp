#include "modules/geometry/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace atrium {

SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace atrium
