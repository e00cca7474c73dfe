#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "modules/geometry/point_grid.hpp"

namespace atrium {

/// Cells of at least this edge (metres), doubled up to three times until those with points hold one and a half each on
/// average: walls of a sparse scan stop rays, too. Errors as PointGrid's.
std::unique_ptr<PointGrid> grid_for_rays(const std::vector<Eigen::Vector3f>& points, double edge,
                                         const Context& context);

/// Moves on to the last cell of the block of 4 × 4 × 4 cells that the ray goes through.
inline void leave_block(std::array<std::int64_t, 3>& at, const std::array<std::int64_t, 3>& step,
                        const std::array<double, 3>& width, std::array<double, 3>& next) {
  std::array<std::int64_t, 3> left{};
  double end = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    left[k] = step[k] > 0 ? 3 - (at[k] & 3) : at[k] & 3;
    if (std::isfinite(next[k])) end = std::min(end, next[k] + static_cast<double>(left[k]) * width[k]);
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (; left[k] > 0 && next[k] < end; --left[k]) {
      at[k] += step[k];
      next[k] += width[k];
    }
}

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
  std::array<std::int64_t, 3> around{-1, -1, -1};  // the block, of 4 cells along each axis
  const PointGrid::Block* block = nullptr;
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
    if (const std::array<std::int64_t, 3> here{at[0] >> 2, at[1] >> 2, at[2] >> 2}; here != around) {
      around = here;
      block = &grid.block(at[0], at[1], at[2]);
      if (block->empty()) leave_block(at, step, width, next);
    }
    if (block->empty()) continue;
    const std::uint32_t cell = block->cell(at[0], at[1], at[2]);
    if (cell != PointGrid::none && visit(cell, length)) return true;
  }
}

}  // namespace atrium
