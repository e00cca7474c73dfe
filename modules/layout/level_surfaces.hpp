#pragma once
#include <vector>

#include "graph/api/context.hpp"
#include "modules/layout/raster.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// A surface that may bound a room from below or above.
struct LevelSurface {
  CellSurface surface;
  bool up = false;    ///< seen from above: a floor
  double height = 0;  ///< mean of its points, metres
  double area = 0;    ///< of the squares that hold points, square metres
};

/// What may be a floor or a ceiling somewhere in a building, whatever its storey: all planes that are not upright and
/// are no furniture.
///
/// - Floors look up, have least_area and hold a square of least_width. What lies 0.25 to `clearance` m higher than a
///   larger floor that goes on under it or around it is furniture, unless walls stand around it (a raised room).
/// - Ceilings look down and lie `clearance` or more over the floor below them; slanted ones rise to that height, and so
///   do steep ones, which are walls that lean. What lies less than that over another ceiling,
///   for the most part, is none.
/// - The ground outside, which no ceiling covers and no walls enclose, is no floor.
/// Surfaces that differ by less than `gap` everywhere are one.
struct LevelLimits {
  double least_area = 0.5, least_width = 0.8, clearance = 1.8, gap = 0.05;
};
std::vector<LevelSurface> level_surfaces(const PlanePrimitives& planes, const std::vector<Footprint>& footprints,
                                         double pixel, const LevelLimits& limits);

}  // namespace atrium::layout
