#pragma once
#include <vector>

#include "modules/layout/wall_cover.hpp"

namespace atrium::layout {

struct RoomLimits {
  double least_area = 0.8;    ///< m²
  double least_cover = 0.25;  ///< share of the area seen as floor, ceiling, or through
};

/// Rooms out of a labelling, as cells with a room, a floor and a ceiling, storey by storey.
///
/// - Inside prisms over each other in a cell are one interval, but not through a slab that was seen, nor through the
///   hole of a stair: where the slab around such a hole has a room above and below and makes up a third of its rim,
///   the hole parts the storeys.
/// - A room is what hangs together of intervals through borders of which walls cover less than half, the widest
///   first, and never has two intervals over one place: what lies over itself is two rooms. Parts of 1 m² or more do
///   not hang together through gaps of less than 0.75 m, or 0.5 m where floor was seen in the cells on both sides of
///   them: cupboards hide the ends of walls, and nobody goes through there.
/// - Rooms of one storey have floors at similar heights (steps of up to a metre) and do not lie over each other.
/// Rooms are numbered by falling area, through all storeys. The log says what was too small or hardly seen.
std::vector<StoreyCells> prism_rooms(const PrismSpace& space, WallCover& walls, std::vector<std::vector<bool>> inside,
                                     const RoomLimits& limits, const Context& context);

}  // namespace atrium::layout
