#pragma once
#include <vector>

#include "modules/layout/raster.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Writes into a storey's cells and edges what was seen of floors, ceilings and walls (see layout.partition).
void measure_coverage(const Structure& structure, const std::vector<Footprint>& footprints, double pixel,
                      StoreyCells& storey);

/// Share of the rows just below the ceiling in which a wall's raster has points at p or in a square beside it.
double wall_reach(const Footprint& wall, const Eigen::Vector2d& p, double floor, double ceiling);

/// Whether the ceiling of a measured storey was scanned at all: a third of what its floor shows.
bool ceiling_scanned(const StoreyCells& storey);

/// Mean RMS distance of points to their planes, weighted by their number: the noise, metres.
double mean_residual(const PlanePrimitives& planes);

/// The mean of a cell's corners.
Eigen::Vector2d middle_of(const StoreyCells& storey, const LayoutCell& cell);

/// Whether p is inside of a polygon (any simple one), by the crossings of a ray.
bool is_inside(const std::vector<Eigen::Vector2d>& vertices, const std::vector<std::uint32_t>& corners,
               const Eigen::Vector2d& p);

}  // namespace atrium::layout
