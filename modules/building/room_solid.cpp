#include "modules/building/room_solid.hpp"

#include <algorithm>

#include "modules/building/room_shell.hpp"
#include "modules/building/shell_welding.hpp"
#include "modules/geometry/plan_overlay.hpp"

namespace atrium::building {
namespace {

/// The openings of a face, as polygons in its plane.
struct Cut {
  std::int32_t opening;
  PlanPolygon polygon;
};

std::vector<Cut> cuts_of(const Building& building, std::int32_t face, const PlaneFrame& frame) {
  std::vector<Cut> cuts;
  for (std::size_t o = 0; o < building.openings.size(); ++o) {
    const BuildingOpening& opening = building.openings[o];
    for (const auto& [pierced, outline] :
         {std::pair(opening.face_a, &opening.outline_a), std::pair(opening.face_b, &opening.outline_b)}) {
      if (pierced != face || outline->size() < 3) continue;
      PlanRing ring;
      ring.reserve(outline->size());
      for (const auto& p : *outline) ring.push_back(frame.to_plane(p));
      cuts.push_back({static_cast<std::int32_t>(o), overlay::corrected({ring, {}})});
    }
  }
  return cuts;
}

struct Pieces {
  std::vector<ShellPiece> shell;
  std::vector<std::int32_t> openings;  ///< per piece

  void add(ShellPiece piece, std::int32_t opening) {
    shell.push_back(std::move(piece));
    openings.push_back(opening);
  }
};

void add_face(const Building& building, std::int32_t index, bool openings, Pieces& pieces) {
  ShellPiece whole = piece_of(building, index);
  const PlaneFrame frame = frame_of(building, whole.face);
  const auto cuts = openings ? cuts_of(building, index, frame) : std::vector<Cut>();
  if (cuts.empty()) {
    pieces.add(std::move(whole), -1);
    return;
  }
  std::vector<PlanPolygon> rest{flat_polygon(building, whole.face)};
  for (const auto& [opening, polygon] : cuts) {
    for (const auto& pane : overlay::intersection(rest, polygon)) pieces.add(part_of(whole, frame, pane), opening);
    rest = overlay::difference(rest, polygon);
  }
  for (const auto& part : rest) pieces.add(part_of(whole, frame, part), -1);
}

}  // namespace

RoomSolid room_solid(const Building& building, const BuildingRoom& room, bool openings) {
  Pieces pieces;
  for (const auto f : room.faces) add_face(building, f, openings, pieces);
  const ShellWelding welding(pieces.shell);
  RoomSolid solid;
  solid.vertices = welding.vertices;
  std::vector<BuildingFace> sides;
  sides.reserve(welding.pieces.size());
  solid.pieces.reserve(welding.pieces.size());
  for (const auto& welded : welding.pieces) {
    const auto at = static_cast<std::size_t>(welded.piece - pieces.shell.data());
    SolidPiece piece{welded.piece->source, pieces.openings[at], welded.rings};
    BuildingFace side;
    side.outline = welded.rings.front();
    side.holes.assign(welded.rings.begin() + 1, welded.rings.end());
    sides.push_back(std::move(side));
    for (auto& ring : piece.rings) std::reverse(ring.begin(), ring.end());
    solid.pieces.push_back(std::move(piece));
  }
  solid.closed = is_closed(sides);
  return solid;
}

}  // namespace atrium::building
