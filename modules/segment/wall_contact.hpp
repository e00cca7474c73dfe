#pragma once
#include <vector>

#include "modules/segment/storeys.hpp"

namespace atrium::segment {

/// Share of the walls' length that belongs to walls whose bounding rectangle is within `distance` (metres) of that of a
/// floor or ceiling. In a room it is near 1; where tables and cupboards only pass for floors and walls it is near 0,
/// since these stand apart. 0 without walls.
double wall_contact(const std::vector<PlaneExtent>& walls, const std::vector<Storey>& storeys, double distance);

}  // namespace atrium::segment
