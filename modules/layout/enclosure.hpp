#pragma once
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Writes into each cell the share of directions, level and from its middle, in which the first wall looks towards it
/// (`LayoutCell::enclosed`): near 1 in rooms, also in those whose ceiling was not scanned; below 0.5 outside and within
/// walls. Walls that end below 60 % of the storey's height do not count; where ceilings were scanned, those below 90 %.
/// Edges must have been measured. Cost: 16 ways of at most 20 m for each cell, on squares of 10 cm or more.
void measure_enclosure(StoreyCells& storey);

/// The height at which a wall ends at least: what ends below 60 % of a storey's height is furniture. Metres.
inline double least_wall_top(double floor, double ceiling) { return floor + 0.6 * (ceiling - floor); }

}  // namespace atrium::layout
