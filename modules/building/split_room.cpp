#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/building/corrections.hpp"
#include "modules/building/room_measures.hpp"

namespace atrium::building {
namespace {

/// What of a ring is on a plane's side. Where the ring crosses it several times, ways along the plane there and back
/// are left, which cancel when the pieces are joined.
std::vector<Eigen::Vector3d> clipped(const std::vector<Eigen::Vector3d>& ring, const Eigen::Vector3d& inwards,
                                     double offset) {
  constexpr double on_plane = 0.0002;  // metres
  const auto side = [&](const Eigen::Vector3d& p) {
    const double distance = inwards.dot(p) - offset;
    return std::abs(distance) < on_plane ? 0.0 : distance;
  };
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector3d &p = ring[i], &q = ring[(i + 1) % ring.size()];
    const double from = side(p), to = side(q);
    if (from >= 0) result.push_back(p);
    if (from * to < 0) result.push_back(p + (q - p) * (from / (from - to)));
  }
  return result;
}

/// The part of a room on one side of an upright plane, closed by it.
std::vector<ShellPiece> half_of(const Building& building, const BuildingRoom& room, const Eigen::Vector3d& inwards,
                                double offset, std::size_t& sections) {
  std::vector<ShellPiece> result;
  for (auto& piece : pieces_of(building, room)) {
    piece.outline = clipped(piece.outline, inwards, offset);
    for (auto& hole : piece.holes) hole = clipped(hole, inwards, offset);
    std::erase_if(piece.holes, [](const auto& hole) { return hole.size() < 3; });
    if (piece.outline.size() >= 3) result.push_back(std::move(piece));
  }
  OpenBorder border = open_border(result, inwards);
  sections = border.outlines.size();
  if (sections != 1) return result;
  ShellPiece cap = new_piece(std::move(border.outlines.front()), inwards);
  cap.holes = std::move(border.holes);
  result.push_back(std::move(cap));
  return result;
}

}  // namespace

void split_room(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t index = draft.room_of(correction);
  const BuildingRoom room = draft.room(index);
  const auto& names = correction.at("names").texts;
  if (names[0] == names[1]) correction.fail("names", "both parts have one name", "rooms have different names");
  for (std::size_t r = 0; r < draft.building.rooms.size(); ++r)
    if (static_cast<std::int32_t>(r) != index &&
        (draft.building.rooms[r].name == names[0] || draft.building.rooms[r].name == names[1]))
      correction.fail("names", fmt::format("there is a room '{}' already", draft.building.rooms[r].name),
                      "rooms have different names");
  const double height = room.outline.empty() ? 0 : room.outline[0].z();
  const Eigen::Vector3d from = draft.place(correction, "from", height), to = draft.place(correction, "to", height);
  const Eigen::Vector2d line = (to - from).head<2>();
  constexpr double shortest = 0.01;  // metres
  if (line.norm() < shortest) correction.fail("to", "both places are one", "the line runs through two of them");
  const Eigen::Vector3d left = Eigen::Vector3d(-line.y(), line.x(), 0).normalized();
  const double half = 0.5 * correction.number_or("thickness", 0);
  const Overlap before = overlap_of(draft.building, {index});
  std::vector<CorrectionDraft::NewRoom> parts;
  for (const double side : {1.0, -1.0}) {
    std::size_t sections = 0;
    RoomShell shell = joined_shell(half_of(draft.building, room, side * left, side * left.dot(from) + half, sections));
    const std::size_t pieces = shell.faces.empty() ? 0 : parts_of(shell.faces);
    if (sections != 1 || pieces != 1 || !is_closed(shell.faces))
      correction.fail(
          "from",
          fmt::format("the line does not cross '{}' exactly twice: it has {} stretches in it", room.name, sections),
          "a room is split in two by a line that crosses its outline at two places");
    BuildingRoom part = room;
    part.name = names[side > 0 ? 0 : 1];
    parts.push_back({std::move(part), std::move(shell)});
  }
  const auto rooms = draft.replace(correction, {index}, std::move(parts));
  settle_rooms(draft, correction, rooms, before);
  for (const auto r : rooms) draft.mark(r, fmt::format("split off from {}", room.name));
}

}  // namespace atrium::building
