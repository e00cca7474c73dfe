#pragma once
#include <map>
#include <tuple>
#include <vector>

#include "modules/types/building.hpp"
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// What the pieces of one polygon have in common.
struct FaceKey {
  SurfaceClass surface = SurfaceClass::wall;
  std::int32_t index = -1;   ///< of the floor, the ceiling or the line
  bool along_normal = true;  ///< walls: whether the face looks to the side that the line's normal points to
  friend bool operator<(const FaceKey& a, const FaceKey& b) {
    return std::tie(a.surface, a.index, a.along_normal) < std::tie(b.surface, b.index, b.along_normal);
  }
};

/// A polygon of a room's surface: rings of indices into RoomSurface::vertices, the outline counter-clockwise and the
/// holes clockwise seen from the room.
struct RoomFace {
  FaceKey key;
  std::vector<std::uint32_t> outline;
  std::vector<std::vector<std::uint32_t>> holes;
};

struct RoomSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<RoomFace> faces;
  std::vector<Eigen::Vector2d> outline;             ///< seen from above, counter-clockwise
  std::vector<std::vector<Eigen::Vector2d>> holes;  ///< clockwise
};

/// The closed surface of a room. Needs cut_pinched_cells, then split_crossing_steps (room_cells.hpp).
RoomSurface room_surface(const StoreyCells& storey, std::int32_t room);

}  // namespace atrium::layout
