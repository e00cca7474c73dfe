#include <algorithm>

#include "modules/io/truth_json.hpp"

namespace atrium::io {
namespace {

using Ring = std::vector<Eigen::Vector3d>;

void add_room(GroundTruth& truth, const JsonField& corners, const std::string& name, std::int32_t storey, double floor,
              double height) {
  TrueRoom room{name, storey, corners.ring(true, floor)};
  const auto area = area_vector(room.outline);
  if (!(std::abs(area.z()) > 0)) corners.fail("have no area seen from above");
  if (area.z() < 0) std::reverse(room.outline.begin(), room.outline.end());
  const auto index = static_cast<std::int32_t>(truth.rooms.size());
  truth.rooms.push_back(room);
  if (!(height > 0)) return;
  const Eigen::Vector3d up(0, 0, height);
  const Ring& low = room.outline;
  truth.faces.push_back(face_of(SurfaceClass::floor, index, storey, low));
  Ring high;
  for (auto p = low.rbegin(); p != low.rend(); ++p) high.emplace_back(*p + up);
  truth.faces.push_back(face_of(SurfaceClass::ceiling, index, storey, high));
  for (std::size_t i = 0; i < low.size(); ++i) {
    const auto &a = low[i], &b = low[(i + 1) % low.size()];
    truth.faces.push_back(face_of(SurfaceClass::wall, index, storey, {b, a, a + up, b + up}));
  }
}

}  // namespace

GroundTruth truth_from_rooms(const JsonField& root) {
  GroundTruth truth;
  const auto name = [&] { return "room " + std::to_string(truth.rooms.size() + 1); };
  if (root.is_list()) {
    for (const auto& corners : root.items()) add_room(truth, corners, name(), 0, 0, 0);
  } else {
    if (root.has("units") && root["units"].text() != "m") root["units"].fail("is not \"m\"", "convert it to metres");
    for (const auto& field : root["rooms"].items()) {
      const auto number = [&](const char* key) { return field.has(key) ? field[key].number() : 0.0; };
      if (number("height") < 0) field["height"].fail("is below 0");
      add_room(truth, field["corners"], field.has("name") ? field["name"].text() : name(),
               field.has("storey") ? field["storey"].whole(0, 10000) : 0, number("floor"), number("height"));
    }
  }
  truth.mesh = mesh_of(truth);
  return truth;
}

}  // namespace atrium::io
