#include "modules/types/plane_primitives.hpp"

namespace atrium {

Cloud transformed(const Cloud& cloud, const Transform& transform) {
  Cloud result = cloud;
  result.origin = transform.rotation * cloud.origin + transform.translation;
  const Eigen::Matrix3f turn = transform.rotation.cast<float>();
  for (auto& p : result.points) p = turn * p;
  for (auto& n : result.normals) n = turn * n;
  for (auto& s : result.sensors) s = turn * s;
  return result;
}

PlanePrimitives transformed(const PlanePrimitives& primitives, const Transform& transform) {
  PlanePrimitives result = primitives;
  result.cloud = std::make_shared<const Cloud>(transformed(*primitives.cloud, transform));
  // Local coordinates only turn: the offset of a plane in them stays.
  for (auto& p : result.primitives) p.plane.normal = (transform.rotation * p.plane.normal).normalized();
  return result;
}

Transform chained(const Transform& first, const Transform& second) {
  return {second.rotation * first.rotation, second.rotation * first.translation + second.translation};
}

Transform inverse(const Transform& transform) {
  const Eigen::Matrix3d back = transform.rotation.transpose();
  return {back, -(back * transform.translation)};
}

}  // namespace atrium
