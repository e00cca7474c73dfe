#pragma once
#include <vector>

#include "modules/layout/raster.hpp"
#include "modules/layout/wall_lines.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// What one storey is made of: candidates, and where they were seen.
struct StoreyPlanes {
  double low = 0, high = 0;
  double floor_height = 0, ceiling_height = 0;
  double wall_end = unknown_top;  ///< below which two fifths of the walls end, if no ceiling was scanned
  std::vector<CellSurface> floors, ceilings;
  std::vector<WallLine> lines;  ///< walls by falling area, then meeting lines of slanted surfaces
};

/// The storeys of a structure, lowest first. `footprints`: of its primitives.
std::vector<StoreyPlanes> storey_planes(const Structure& structure, const std::vector<Footprint>& footprints,
                                        double min_gap);

}  // namespace atrium::layout
