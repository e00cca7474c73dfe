#pragma once
#include <vector>

#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Walls that were not seen because something stands before them. Where both faces of a wall run on beside a cell no
/// wider than a wall, and no ceiling was seen there (no floor, where the storey's ceiling was not scanned), the wall
/// goes on. All values are likelihoods, 0 to 1; 0 of cells too narrow to have been measured.
struct HiddenWalls {
  std::vector<double> cells;        ///< per cell: that it is the inside of a wall
  std::vector<double> left, right;  ///< per edge: that a wall stands on it which looks to the left, to the right
};
HiddenWalls hidden_walls(const StoreyCells& storey, bool ceiling_scanned);

/// Area over the longest side: the thickness of what is between the faces of a wall.
double width_of(const StoreyCells& storey, const LayoutCell& cell);

}  // namespace atrium::layout
