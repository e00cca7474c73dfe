#include "modules/geometry/plane_frame.hpp"

#include <Eigen/Geometry>

namespace atrium {

PlaneFrame upright_frame(const Plane& plane, const Eigen::Vector3d& near) {
  constexpr double horizontal = 1e-9;  // length of z × normal below which its direction is rounding
  const Eigen::Vector3d& n = plane.normal;
  PlaneFrame frame;
  frame.origin = near - n * plane.signed_distance(near);
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(n);
  frame.u = across.norm() > horizontal ? across.normalized() : Eigen::Vector3d::UnitX();
  frame.v = n.cross(frame.u).normalized();
  return frame;
}

}  // namespace atrium
