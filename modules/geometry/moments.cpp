#include "modules/geometry/moments.hpp"

#include "modules/geometry/symmetric_eigen.hpp"

namespace atrium {

PlaneFit fit_plane(const Moments& moments) {
  PlaneFit fit;
  if (moments.count == 0) return fit;
  fit.mean = moments.mean();
  const SymmetricEigen principal = symmetric_eigen(moments.covariance());
  fit.variances = principal.values.cwiseMax(0.0);
  fit.axes = principal.vectors;
  Eigen::Vector3d normal = fit.axes.col(0).normalized();
  Eigen::Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  if (normal[largest] < 0) normal = -normal;
  fit.plane = {normal, -normal.dot(fit.mean)};
  return fit;
}

}  // namespace atrium
