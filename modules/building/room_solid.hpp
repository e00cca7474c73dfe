#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/types/building.hpp"

namespace atrium::building {

/// A polygon of a room's surface with openings cut out of its faces.
struct SolidPiece {
  std::int32_t face = -1;     ///< of the building: that it is, or that its opening pierces
  std::int32_t opening = -1;  ///< of the building; −1: a part of the face itself
  std::vector<std::vector<std::uint32_t>>
      rings;  ///< the outline, clockwise seen from the room; then holes, the other way
};

/// A room's surface, seen from outside: rings are indices into `vertices`, metres relative to the building's origin.
struct RoomSolid {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<SolidPiece> pieces;
  bool closed = false;  ///< each side of a polygon is a side of another one that runs the other way
};

/// The surface of a room, with its openings as polygons of their own unless `openings` is false. Places at most half a
/// millimetre apart are one; polygons of less than a square millimetre are left out.
RoomSolid room_solid(const Building& building, const BuildingRoom& room, bool openings);

}  // namespace atrium::building
