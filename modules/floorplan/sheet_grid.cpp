#include "modules/floorplan/sheet_grid.hpp"

#include <algorithm>
#include <numeric>

namespace atrium::floorplan {
namespace {

constexpr double around = 7;  // millimetres between drawings, and to the frame

double sum(const std::vector<double>& sizes, std::size_t count) {
  return std::accumulate(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(count), 0.0);
}

double need_of(const std::vector<double>& sizes) {
  return sum(sizes, sizes.size()) + around * static_cast<double>(sizes.size() + 1);
}

// Where cell `at` begins along an axis of length `room`.
double begin_of(const std::vector<double>& sizes, std::size_t at, double room) {
  const double between = around + (room - need_of(sizes)) / static_cast<double>(sizes.size() + 1);
  return sum(sizes, at) + between * static_cast<double>(at + 1);
}

}  // namespace

SheetGrid::SheetGrid(const std::vector<Eigen::Vector2d>& sizes, std::size_t columns)
    : widths(columns, 0.0), heights((sizes.size() + columns - 1) / columns, 0.0) {
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    widths[i % columns] = std::max(widths[i % columns], sizes[i].x());
    heights[i / columns] = std::max(heights[i / columns], sizes[i].y());
  }
}

Eigen::Vector2d SheetGrid::need() const { return {need_of(widths), need_of(heights)}; }

Eigen::Vector2d SheetGrid::corner(std::size_t i, const Eigen::Vector2d& size, const Eigen::Vector2d& room) const {
  const std::size_t column = i % widths.size(), row = i / widths.size();
  const double left = begin_of(widths, column, room.x()) + 0.5 * (widths[column] - size.x());
  const double bottom = begin_of(heights, row, room.y()) + 0.5 * (heights[row] - size.y());
  return {left, room.y() - bottom - size.y()};
}

std::vector<std::size_t> column_counts(std::size_t count) {
  std::vector<std::size_t> columns{std::max<std::size_t>(count, 1), 1};
  for (std::size_t rows = 2; rows < count; ++rows)
    if (const std::size_t wide = (count + rows - 1) / rows; wide > 1 && wide != columns.back()) columns.push_back(wide);
  std::stable_sort(columns.begin() + 2, columns.end(),
                   [&](std::size_t a, std::size_t b) { return (a - count % a) % a < (b - count % b) % b; });
  return columns;
}

}  // namespace atrium::floorplan
