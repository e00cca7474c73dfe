#pragma once
#include <vector>

#include "modules/types/building.hpp"

namespace atrium::layout {

/// What rooms that were found in another way say of a room.
struct SecondOpinion {
  double shared = 0;      ///< of both places together, what the room and the one that fits it best share, 0 to 1
  double area = 0;        ///< of that other room, square metres; 0: there is none
  std::size_t parts = 0;  ///< how many of the other rooms lie in it for the most part
};

/// One for each room of `building`. Rooms are compared seen from above, where half of the lower one's height or more is
/// common. Both have one frame. Cost: an overlay of polygons for each two rooms whose boxes overlap.
std::vector<SecondOpinion> second_opinions(const Building& building, const Building& other);

}  // namespace atrium::layout
