#include "modules/geometry/linear_solve.hpp"

#include <Eigen/LU>

namespace atrium {

Eigen::Vector3d linear_solve(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right) {
  return matrix.partialPivLu().solve(right);
}

}  // namespace atrium
