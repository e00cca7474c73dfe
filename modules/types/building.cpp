#include "modules/types/building.hpp"

namespace atrium {

Building transformed(const Building& building, const Transform& transform) {
  Building result = building;
  const auto turn = [&](std::vector<Eigen::Vector3d>& places) {
    for (auto& p : places) p = transform.rotation * p;
  };
  result.origin = transform.rotation * building.origin + transform.translation;
  turn(result.vertices);
  for (auto& room : result.rooms) {
    turn(room.outline);
    for (auto& hole : room.holes) turn(hole);
  }
  for (auto& face : result.faces) face.plane.normal = transform.rotation * face.plane.normal;
  for (auto& opening : result.openings) {
    turn(opening.outline_a);
    turn(opening.outline_b);
  }
  return result;
}

}  // namespace atrium
