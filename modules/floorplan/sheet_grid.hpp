#pragma once
#include <vector>

#include "modules/floorplan/plan_view.hpp"

namespace atrium::floorplan {

/// Drawings in the cells of a grid, from the left to the right and from the bottom to the top. Millimetres.
struct SheetGrid {
  std::vector<double> widths;   ///< of the columns
  std::vector<double> heights;  ///< of the rows, the lowest first

  SheetGrid(const std::vector<Eigen::Vector2d>& sizes, std::size_t columns);
  /// With what is left free between the drawings and around them.
  Eigen::Vector2d need() const;
  /// Upper left corner (y down) of drawing i of that size if the grid fills `room`: what is left over is shared out.
  Eigen::Vector2d corner(std::size_t i, const Eigen::Vector2d& size, const Eigen::Vector2d& room) const;
};

/// How many columns are worth a try for `count` drawings: a row, a column, then one for each number of rows between,
/// those that leave the fewest cells empty first.
std::vector<std::size_t> column_counts(std::size_t count);

}  // namespace atrium::floorplan
