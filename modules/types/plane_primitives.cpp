#include "modules/types/plane_primitives.hpp"

namespace atrium {

namespace {

std::vector<Eigen::Vector3f> turned(const std::vector<Eigen::Vector3f>& column, const Eigen::Matrix3f& rotation) {
  std::vector<Eigen::Vector3f> result;
  result.reserve(column.size());
  for (const auto& v : column) result.emplace_back(rotation * v);
  return result;
}

}  // namespace

Cloud transformed(const Cloud& cloud, const Transform& transform) {
  const Eigen::Matrix3f turn = transform.rotation.cast<float>();
  Cloud result;
  result.origin = transform.rotation * cloud.origin + transform.translation;
  result.points = turned(cloud.points, turn);
  result.normals = turned(cloud.normals, turn);
  result.colours = cloud.colours;
  result.labels = cloud.labels;
  result.intensities = cloud.intensities;
  result.source = cloud.source;
  result.sensors = turned(cloud.sensors, turn);
  result.unit = cloud.unit;
  result.crs = cloud.crs;
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
  return {second.rotation * first.rotation, second.rotation * first.translation + second.translation,
          first.upright * second.upright};
}

Transform inverse(const Transform& transform) {
  const Eigen::Matrix3d back = transform.rotation.transpose();
  return {back, -(back * transform.translation), transform.upright};
}

}  // namespace atrium
