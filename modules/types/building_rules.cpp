#include "modules/types/building_rules.hpp"

#include <fmt/format.h>

#include <cmath>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

using Ring = std::vector<std::uint32_t>;

class Check {
 public:
  explicit Check(const Building& building) : building_(building) {}

  void run() const {
    if (!building_.origin.allFinite()) throw Error("the building's origin has a number that is not finite");
    if (!std::isfinite(building_.confidence))
      throw Error("the building's confidence is not finite", "where nobody has judged it, it is -1");
    for (std::size_t i = 0; i < building_.vertices.size(); ++i) finite(building_.vertices[i].allFinite(), "vertex", i);
    for (std::size_t i = 0; i < building_.storeys.size(); ++i)
      finite(std::isfinite(building_.storeys[i].elevation + building_.storeys[i].height), "storey", i);
    for (std::size_t i = 0; i < building_.rooms.size(); ++i) room(building_.rooms[i], i);
    for (std::size_t i = 0; i < building_.faces.size(); ++i) face(building_.faces[i], i);
    for (std::size_t i = 0; i < building_.openings.size(); ++i) opening(building_.openings[i], i);
    for (std::size_t i = 0; i < building_.walls.size(); ++i) wall(building_.walls[i], i);
  }

 private:
  static void finite(bool is, const char* what, std::size_t index) {
    if (!is) throw Error(fmt::format("{} {} of the building has a number that is not finite", what, index));
  }
  static void index(std::int64_t value, std::int64_t least, std::size_t count, const char* what, std::size_t i,
                    const char* of) {
    if (value < least || value >= static_cast<std::int64_t>(count))
      throw Error(fmt::format("{} {} of the building names {} {} of {}", what, i, of, value, count),
                  "they are counted from 0");
  }
  void corners(const Ring& ring, std::size_t i) const {
    if (ring.size() < 3) throw Error(fmt::format("face {} of the building has fewer than three corners", i));
    for (const auto v : ring) index(v, 0, building_.vertices.size(), "face", i, "vertex");
  }
  static void places(const std::vector<Eigen::Vector3d>& ring, const char* what, std::size_t i) {
    for (const auto& p : ring) finite(p.allFinite(), what, i);
  }

  void room(const BuildingRoom& room, std::size_t i) const {
    finite(std::isfinite(room.area + room.height + room.volume + room.confidence), "room", i);
    places(room.outline, "room", i);
    for (const auto& hole : room.holes) places(hole, "room", i);
    index(room.storey, 0, building_.storeys.size(), "room", i, "storey");
    for (const auto f : room.faces) index(f, 0, building_.faces.size(), "room", i, "face");
  }
  void face(const BuildingFace& face, std::size_t i) const {
    finite(face.plane.normal.allFinite() &&
               std::isfinite(face.plane.offset + face.observed + face.residual + face.backing),
           "face", i);
    index(face.storey, 0, building_.storeys.size(), "face", i, "storey");
    index(face.room, -1, building_.rooms.size(), "face", i, "room");
    corners(face.outline, i);
    for (const auto& hole : face.holes) corners(hole, i);
  }
  void opening(const BuildingOpening& opening, std::size_t i) const {
    finite(std::isfinite(opening.thickness), "opening", i);
    places(opening.outline_a, "opening", i);
    places(opening.outline_b, "opening", i);
    for (const auto r : {opening.room_a, opening.room_b}) index(r, -1, building_.rooms.size(), "opening", i, "room");
    for (const auto f : {opening.face_a, opening.face_b}) index(f, -1, building_.faces.size(), "opening", i, "face");
  }
  void wall(const BuildingWall& wall, std::size_t i) const {
    finite(std::isfinite(wall.thickness + wall.area), "wall", i);
    for (const auto f : {wall.face_a, wall.face_b}) index(f, 0, building_.faces.size(), "wall", i, "face");
  }

  const Building& building_;
};

}  // namespace

void check(const Building& building) { Check(building).run(); }

Building with_origin(Building building, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d shift = building.origin - origin;
  building.origin = origin;
  const auto move = [&](std::vector<Eigen::Vector3d>& places) {
    for (auto& p : places) p += shift;
  };
  move(building.vertices);
  for (auto& storey : building.storeys) storey.elevation += shift.z();
  for (auto& face : building.faces) face.plane.offset -= face.plane.normal.dot(shift);
  for (auto& room : building.rooms) {
    move(room.outline);
    for (auto& hole : room.holes) move(hole);
  }
  for (auto& opening : building.openings) {
    move(opening.outline_a);
    move(opening.outline_b);
  }
  return building;
}

}  // namespace atrium
