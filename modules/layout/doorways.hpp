#pragma once
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Closes the doorways of a storey whose ceiling was not scanned. Elsewhere a door's lintel parts two rooms: the wall
/// over it reaches the ceiling. Where walls were seen up to the lintel at most (a robot's scanner, a scan cut at head
/// height), a gap no wider than a door (1.35 m) between two pieces of one wall, both at least 15 cm long, says that the
/// wall goes on; so does one narrower than a door wherever the walls end. Where walls run away from both of its ends, a
/// corridor passes between two walls, and nothing is closed. Writes `wall` and `face` of the edges in such
/// gaps; edges must have been measured.
void close_doorways(StoreyCells& storey);

}  // namespace atrium::layout
