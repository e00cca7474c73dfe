#include "modules/types/turn_between.hpp"

#include <cmath>

namespace atrium {

Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr double opposite = -1 + 1e-12;
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  if (cosine < opposite) {
    const Eigen::Vector3d axis = a.unitOrthogonal();
    return {0, axis.x(), axis.y(), axis.z()};
  }
  const Eigen::Vector3d axis = a.cross(b);
  const double s = std::sqrt((1 + cosine) * 2);
  return {s * 0.5, axis.x() / s, axis.y() / s, axis.z() / s};
}

}  // namespace atrium
