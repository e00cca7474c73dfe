#pragma once
#include <cstdint>
#include <vector>

#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Takes out of rooms what lies in a wall between two of them: cells within 30 cm behind a wall that was seen from
/// the other room only, over and under which neither a floor nor a ceiling was seen. Without it, a room whose own face
/// of the wall was not seen reaches to the back of the other room's, and both touch in a wall without thickness.
///
/// `rooms`: per cell its room's number, -1 outside; cells in walls become -1. Cost: one pass over the edges.
void clear_wall_bodies(const StoreyCells& storey, std::vector<std::int32_t>& rooms);

}  // namespace atrium::layout
