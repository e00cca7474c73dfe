#pragma once
#include <array>
#include <cmath>
#include <limits>

#include "modules/geometry/point_grid.hpp"

namespace atrium {

/// Walks along a ray through the cells of a grid, from the one around `from` on, which is not visited itself, and calls
/// visit(cell, length) for each cell that holds points, nearest first; `length` is where the ray enters the cell. Ends
/// when visit returns true, beyond `range` metres, or where the ray leaves the grid. Returns whether visit ended it.
/// `from` and `direction` (unit length) are in the points' frame. Source: J. Amanatides, A. Woo, A fast voxel traversal
/// algorithm for ray tracing, Eurographics 1987.
template <class Visit>
bool walk(const PointGrid& grid, const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double range,
          const Visit& visit) {
  const double size = grid.cell_size();
  const std::array<std::int64_t, 3> start = grid.place(from);
  std::array<std::int64_t, 3> at = start;
  std::array<std::int64_t, 3> step{};
  std::array<double, 3> next{}, width{};
  const Eigen::Vector3d corner = grid.corner();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double d = direction[i];
    const double to_middle = corner[i] + (static_cast<double>(at[axis]) + 0.5) * size - from[i];
    step[axis] = d < 0 ? -1 : 1;
    width[axis] = d == 0 ? std::numeric_limits<double>::infinity() : size / std::abs(d);
    next[axis] = d == 0 ? width[axis] : std::max(0.0, (to_middle + static_cast<double>(step[axis]) * size / 2) / d);
  }
  for (;;) {
    const std::size_t axis = next[0] <= next[1] && next[0] <= next[2] ? 0 : next[1] <= next[2] ? 1 : 2;
    const double length = next[axis];
    at[axis] += step[axis];
    next[axis] += width[axis];
    if (length > range) return false;
    if (step[axis] < 0 ? at[axis] < 0 : at[axis] >= grid.extent()[axis]) return false;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && at[k] >= 0 && at[k] < grid.extent()[k];
    if (!inside) continue;
    const std::uint32_t cell =
        grid.find(static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]), static_cast<std::int32_t>(at[2]));
    if (cell != PointGrid::none && visit(cell, length)) return true;
  }
}

}  // namespace atrium
