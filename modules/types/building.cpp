#include "modules/types/building.hpp"

#include <algorithm>
#include <string_view>

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

std::vector<Fact> Building::facts(const Building& building) {
  double area = 0;
  double volume = 0;
  for (const auto& room : building.rooms) {
    area += room.area;
    volume += room.volume;
  }
  const auto openings = [&](std::string_view kind) {
    return static_cast<std::int64_t>(std::count_if(building.openings.begin(), building.openings.end(),
                                                   [&](const auto& o) { return o.kind == kind; }));
  };
  const auto inferred =
      std::count_if(building.faces.begin(), building.faces.end(), [](const auto& face) { return face.primitive < 0; });
  std::vector<Fact> facts{{"building.storeys", static_cast<std::int64_t>(building.storeys.size()), ""},
                          {"building.rooms", static_cast<std::int64_t>(building.rooms.size()), ""},
                          {"building.area", area, "m2"},
                          {"building.volume", volume, "m3"},
                          {"building.faces", static_cast<std::int64_t>(building.faces.size()), ""},
                          {"building.inferred_faces", static_cast<std::int64_t>(inferred), ""},
                          {"building.doors", openings("door"), ""},
                          {"building.passages", openings("passage"), ""},
                          {"building.windows", openings("window"), ""},
                          {"building.slab_openings", openings("slab"), ""}};
  if (building.confidence >= 0) facts.push_back({"building.confidence", building.confidence, ""});
  return facts;
}

}  // namespace atrium
