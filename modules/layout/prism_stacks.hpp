#pragma once
#include <vector>

#include "graph/api/context.hpp"
#include "modules/layout/level_surfaces.hpp"
#include "modules/layout/wall_lines.hpp"

namespace atrium::layout {

/// The surfaces over a cell, lowest first, and the prisms between them: prism k lies between surfaces k − 1 and k, so
/// the first is open below and the last above.
struct PrismStack {
  std::vector<std::int32_t> surfaces;  ///< indices into PrismSpace::surfaces
  std::vector<double> cover;           ///< per surface: the share of the cell over which it was seen
  std::vector<double> free;            ///< per prism: the share of the cell over which something was seen through it
  std::vector<double> on_floor;        ///< per prism: the share over which its floor was seen, and nothing above
};

/// A building's space cut in plan into convex cells, each with its stack of prisms. One for all storeys.
struct PrismSpace {
  std::vector<LevelSurface> surfaces;
  StoreyCells plan;  ///< vertices, lines, edges and cells; its floors and ceilings are the surfaces' planes
  std::vector<PrismStack> stacks;  ///< per cell
  double pixel = 0, noise = 0;

  double height(std::int32_t surface, const Eigen::Vector2d& p) const {
    return surfaces[static_cast<std::size_t>(surface)].surface.height_at(p);
  }
};

/// Cuts the plan along `lines` and where slanted surfaces cross, stacks the surfaces over each cell and measures what
/// was seen of them. A surface is in the stacks of the cells that it was seen in and, if it is level, of those within
/// `reach` metres; if it is slanted, within one metre; a steep one goes on nowhere. Cost: linear in the points of
/// surfaces that are not upright.
PrismSpace prism_space(const PlanePrimitives& planes, const std::vector<Footprint>& footprints,
                       std::vector<LevelSurface> surfaces, const std::vector<WallLine>& lines, double pixel,
                       double noise, double margin, double extension, double reach, const Context& context);

/// Metres of height that a prism of the left cell and one of the right have in common, mean over the edge.
double common_height(const PrismSpace& space, const CellEdge& edge, std::size_t left, std::size_t right);

}  // namespace atrium::layout
