#pragma once
#include <cstdint>
#include <vector>

#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

constexpr double one_height = 2e-3;  ///< metres: heights over a vertex nearer to each other than this are one

/// Height of a cell's floor, and of its ceiling, which is never below the floor. Needs a cell of a room.
double floor_at(const StoreyCells& storey, const LayoutCell& cell, const Eigen::Vector2d& p);
double ceiling_at(const StoreyCells& storey, const LayoutCell& cell, const Eigen::Vector2d& p);

/// Cuts cells in which the ceiling comes down to the floor: what is behind is no longer of the room.
void cut_pinched_cells(StoreyCells& storey);

/// Adds a vertex to each edge within a room over which the floors or ceilings of both sides cross.
void split_crossing_steps(StoreyCells& storey);

/// Makes each part of a room that hangs together a room: where the cut has parted one, its parts become rooms of their
/// own, the larger first, and the numbers of those of which nothing is left are given to the next. Two cells hang
/// together over an edge on which there is space in both. Returns how many rooms there are.
std::int32_t number_rooms(std::vector<StoreyCells>& storeys);

}  // namespace atrium::layout
