#pragma once
#include <cstdint>
#include <map>

#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Adds a level ceiling to the storey for each room of which less than `min_seen` (a share of its area) lies under a
/// scanned one: where its walls end. That is the height above which a third of their length rises: things before walls
/// hide their tops, and nothing makes them higher. Returns the index of each such ceiling, by room.
std::map<std::int32_t, std::int32_t> infer_ceilings(StoreyCells& storey, double min_seen);

}  // namespace atrium::layout
