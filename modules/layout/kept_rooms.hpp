#pragma once
#include <vector>

#include "modules/types/building.hpp"

namespace atrium::layout {

/// The building with those rooms only, their faces, openings, pairs of walls and storeys, all numbered anew in their
/// order; names stay. An opening into a room that is gone leads to what is not known. Faces of no room stay.
Building with_rooms(const Building& building, const std::vector<bool>& kept);

}  // namespace atrium::layout
