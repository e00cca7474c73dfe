#include "modules/geometry/moments.hpp"

#include <Eigen/Eigenvalues>

namespace atrium {

PlaneFit fit_plane(const Moments& moments) {
  PlaneFit fit;
  if (moments.count == 0) return fit;
  fit.mean = moments.mean();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(moments.covariance());
  fit.variances = solver.eigenvalues().cwiseMax(0.0);
  fit.axes = solver.eigenvectors();
  Eigen::Vector3d normal = fit.axes.col(0).normalized();
  Eigen::Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  if (normal[largest] < 0) normal = -normal;
  fit.plane = {normal, -normal.dot(fit.mean)};
  return fit;
}

}  // namespace atrium
