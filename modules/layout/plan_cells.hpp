#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "modules/layout/raster.hpp"
#include "modules/layout/wall_lines.hpp"
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// What level surfaces and walls take up in plan.
Eigen::AlignedBox2d extent_of(const std::vector<const std::vector<CellSurface>*>& levels,
                              const std::vector<WallLine>& walls, const std::vector<Footprint>& footprints);

/// The cells of an arrangement with their edges.
void take_cells(const Arrangement& arrangement, StoreyCells& storey);

/// The sides of the box are lines too, for rooms that nothing ends before.
void add_border(const Eigen::AlignedBox2d& box, StoreyCells& storey);

}  // namespace atrium::layout
