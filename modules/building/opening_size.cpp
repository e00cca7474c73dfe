#include "modules/building/opening_size.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/geometry/polygon.hpp"

namespace atrium::building {
namespace {

OpeningSize of_side(const Building& building, const std::vector<Eigen::Vector3d>& outline, std::int32_t face) {
  const Eigen::Vector3d normal = vector_area(outline).normalized();
  Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(normal);
  level = level.norm() > 1e-3 ? Eigen::Vector3d(level.normalized()) : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d rise = normal.cross(level);
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300, foot = 1e300, ground = 1e300;
  for (const auto& p : outline) {
    left = std::min(left, level.dot(p));
    right = std::max(right, level.dot(p));
    low = std::min(low, rise.dot(p));
    high = std::max(high, rise.dot(p));
    foot = std::min(foot, p.z());
  }
  if (face < 0) return {right - left, high - low, 0};
  for (const auto v : building.faces[static_cast<std::size_t>(face)].outline)
    ground = std::min(ground, building.vertices[v].z());
  return {right - left, high - low, foot - ground};
}

}  // namespace

OpeningSize size_of(const Building& building, const BuildingOpening& opening) {
  if (opening.outline_a.size() < 3) return {};
  OpeningSize size = of_side(building, opening.outline_a, opening.face_a);
  if (opening.outline_b.size() < 3) return size;
  const OpeningSize other = of_side(building, opening.outline_b, opening.face_b);
  size.width = 0.5 * (size.width + other.width);
  size.height = 0.5 * (size.height + other.height);
  return size;
}

}  // namespace atrium::building
