#include "modules/building/upright_building.hpp"

#include <Eigen/Geometry>

#include "modules/types/building_rules.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::building {

UprightBuilding upright_building(const Building& building, const Transform& transform, bool near_zero) {
  constexpr double level = 1e-9, near = 1000;  // metres
  UprightBuilding result;
  const Transform back = inverse(transform);
  Eigen::AlignedBox3d box;
  for (const auto& v : building.vertices) box.extend(v);
  const Eigen::Vector3d middle = building.origin + (box.isEmpty() ? Eigen::Vector3d::Zero().eval() : box.center());
  const Eigen::Vector3d pivot = (back.rotation * middle + back.translation).array().round();
  const Eigen::Vector3d up = back.rotation * Eigen::Vector3d::UnitZ();
  if ((up - Eigen::Vector3d::UnitZ()).norm() > level) {
    result.turn.rotation = turn_between(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    result.turn.translation = pivot - result.turn.rotation * pivot;
  }
  const bool zero = near_zero && pivot.norm() <= near;
  result.building =
      with_origin(transformed(building, chained(back, result.turn)), zero ? Eigen::Vector3d::Zero().eval() : pivot);
  return result;
}

}  // namespace atrium::building
