#include "modules/layout/kept_rooms.hpp"

#include <algorithm>
#include <utility>

namespace atrium::layout {
namespace {

/// New numbers of what is kept; −1 for what is not.
struct Numbers {
  std::vector<std::int32_t> of;
  explicit Numbers(const std::vector<bool>& kept) {
    std::int32_t next = 0;
    for (const bool keep : kept) of.push_back(keep ? next++ : -1);
  }
  std::int32_t operator()(std::int32_t old) const { return old < 0 ? -1 : of[static_cast<std::size_t>(old)]; }
};

/// The opening as seen from the side that is left; false if none is.
bool keep_opening(BuildingOpening& opening, const Numbers& rooms, const Numbers& faces) {
  opening.room_a = rooms(opening.room_a);
  opening.room_b = rooms(opening.room_b);
  opening.face_a = faces(opening.face_a);
  opening.face_b = faces(opening.face_b);
  if (opening.face_a < 0) {
    std::swap(opening.room_a, opening.room_b);
    std::swap(opening.face_a, opening.face_b);
    std::swap(opening.outline_a, opening.outline_b);
  }
  if (opening.face_a < 0) return false;
  if (opening.face_b < 0) {
    opening.room_b = -1;
    opening.thickness = 0;
    opening.outline_b.clear();
  }
  return true;
}

void drop_unused_vertices(Building& building) {
  std::vector<bool> used(building.vertices.size(), false);
  const auto each_corner = [&](const auto& work) {
    for (auto& face : building.faces) {
      for (auto& v : face.outline) work(v);
      for (auto& hole : face.holes)
        for (auto& v : hole) work(v);
    }
  };
  each_corner([&](std::uint32_t& v) { used[v] = true; });
  const Numbers numbers(used);
  std::vector<Eigen::Vector3d> vertices;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) vertices.push_back(building.vertices[v]);
  each_corner([&](std::uint32_t& v) { v = static_cast<std::uint32_t>(numbers.of[v]); });
  building.vertices = std::move(vertices);
}

}  // namespace

Building with_rooms(const Building& building, const std::vector<bool>& kept) {
  std::vector<bool> faces_kept, storeys_kept(building.storeys.size(), false);
  for (const auto& face : building.faces)
    faces_kept.push_back(face.room < 0 || kept[static_cast<std::size_t>(face.room)]);
  for (std::size_t r = 0; r < building.rooms.size(); ++r)
    if (kept[r]) storeys_kept[static_cast<std::size_t>(building.rooms[r].storey)] = true;
  for (const auto& face : building.faces)
    if (face.room < 0) storeys_kept[static_cast<std::size_t>(face.storey)] = true;
  const Numbers rooms(kept), faces(faces_kept), storeys(storeys_kept);
  Building result = building;
  const auto filter = [](auto& list, const std::vector<bool>& keep) {
    std::size_t i = 0;
    std::erase_if(list, [&](const auto&) { return !keep[i++]; });
  };
  filter(result.rooms, kept);
  filter(result.faces, faces_kept);
  filter(result.storeys, storeys_kept);
  for (auto& room : result.rooms) {
    room.storey = storeys(room.storey);
    for (auto& f : room.faces) f = faces(f);
  }
  for (auto& face : result.faces) {
    face.room = rooms(face.room);
    face.storey = storeys(face.storey);
  }
  std::erase_if(result.openings, [&](BuildingOpening& opening) { return !keep_opening(opening, rooms, faces); });
  std::erase_if(result.walls, [&](BuildingWall& wall) {
    wall.face_a = faces(wall.face_a);
    wall.face_b = faces(wall.face_b);
    return wall.face_a < 0 || wall.face_b < 0;
  });
  drop_unused_vertices(result);
  return result;
}

}  // namespace atrium::layout
