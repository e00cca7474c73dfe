#pragma once
#include "modules/types/building.hpp"

namespace atrium::building {

struct UprightBuilding {
  Building building;
  Transform turn;  ///< from the frame that is wanted; the identity where its z points up
};

/// The building in the frame from which `transform` leads to it, turned upright by the least rotation about its middle
/// if up is not z there. Its origin is a whole metre near its middle; with `near_zero` zero, where the middle is at
/// most a kilometre from it.
UprightBuilding upright_building(const Building& building, const Transform& transform, bool near_zero);

}  // namespace atrium::building
