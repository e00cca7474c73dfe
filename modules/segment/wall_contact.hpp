#pragma once
#include <vector>

#include "modules/segment/storeys.hpp"

namespace atrium::segment {

/// Share of the walls' length with a floor at its foot or a ceiling at its head: within `distance` (metres) of the
/// wall's lower or upper edge, by the planes' bounding rectangles. In a room it is near 1 but for what was not seen;
/// where tables and cupboards only pass for floors and walls it is near 0, since cupboards do not stand on tables. 0
/// without walls.
double wall_contact(const std::vector<PlaneExtent>& walls, const std::vector<Storey>& storeys, double distance);

}  // namespace atrium::segment
