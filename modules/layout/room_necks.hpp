#pragma once
#include <cstddef>
#include <vector>

#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Parts cells that hang together where they do so through less than 40 cm only: no one passes there, so a piece of a
/// wall was not seen. Each part is as wide as that over half a square metre; cells that lie in the neck are in none.
/// What no neck parts comes back whole. Cost: one pass over squares of 5 cm, or up to 10 cm where a million of these do
/// not cover the plan of the cells (100 m × 100 m); nothing is parted where that is larger.
std::vector<std::vector<std::size_t>> parted_at_necks(const StoreyCells& storey, const std::vector<std::size_t>& cells);

}  // namespace atrium::layout
