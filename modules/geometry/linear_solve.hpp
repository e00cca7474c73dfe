#pragma once
#include <Eigen/Core>

namespace atrium {

/// The x with matrix · x = right, by LU decomposition with partial pivoting (Eigen's, compiled here alone: it costs
/// each file that calls it two seconds). Of a singular matrix the result is not finite, or meaningless.
Eigen::Vector3d linear_solve(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right);

}  // namespace atrium
