#pragma once
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Writes into each cell the share of directions, level and from its middle, in which the first wall looks towards it
/// (`LayoutCell::enclosed`): near 1 in rooms, also in those whose ceiling was not scanned; below 0.5 outside and within
/// walls. Walls that end below 60 % of the storey's height do not count; where ceilings were scanned, those below 90 %.
/// Edges must have been measured. Cost: 16 ways of at most 20 m for each cell, on squares of 10 cm or more.
void measure_enclosure(StoreyCells& storey);

/// The height at which a wall ends at least, metres: what ends below 60 % of a storey's height is furniture. Where no
/// ceiling was scanned and the scanner saw the lower part of most walls only (a robot's does), 70 % of what it saw of
/// them, but no less than 1 m: worktops are lower. `storey`: StoreyCells or StoreyPlanes.
template <class Storey>
double least_wall_top(const Storey& storey) {
  constexpr double of_storey = 0.6, of_walls = 0.7, worktop = 1.0;  // shares; metres
  const double top = of_storey * (storey.ceiling_height - storey.floor_height);
  if (storey.wall_end <= storey.floor_height) return storey.floor_height + top;
  return storey.floor_height + std::min(top, std::max(worktop, of_walls * (storey.wall_end - storey.floor_height)));
}

}  // namespace atrium::layout
