#pragma once
#include <vector>

#include "modules/layout/storey_planes.hpp"

namespace atrium::layout {

/// Where a scan ends without a wall, the room ends where its floor or its ceiling does: lines without primitives, along
/// the axes, at the ends of the floors and of the ceilings that mostly lie far from any wall. Where only one of the two
/// was seen, the line lies 0.25 m further out, since scans mostly end before the wall. Metres, z up; `planes` with
/// their heights and lines. Cost: a few passes over the squares of floors and ceilings.
std::vector<WallLine> end_lines(const StoreyPlanes& planes, const std::vector<Footprint>& footprints);

}  // namespace atrium::layout
