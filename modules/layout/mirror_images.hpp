#pragma once
#include <vector>

#include "modules/types/building.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

/// A room that shows what another one shows, mirrored at one of that one's walls: a mirror's image, or a window's.
struct MirrorImage {
  std::size_t room = 0, of = 0;  ///< numbers of rooms; `room` is the one with fewer points
  double share = 0;              ///< of the points of what stands in it that have one where the other room has theirs
};

/// What stands in the rooms (all points 20 cm or more off the room's faces) is compared both ways, and with what fits
/// half a metre beside. Rooms that were built and furnished as each other's image are that at the middle of the wall
/// between them; an image is one at the wall's face. Of rooms with less than
/// 300 such points nothing is said. Building and planes have one origin, z up. Cost: one pass over at most 400,000 of
/// the points, and for each two rooms whose middles are each other's image some over theirs.
std::vector<MirrorImage> mirror_images(const Building& building, const PlanePrimitives& planes);

}  // namespace atrium::layout
