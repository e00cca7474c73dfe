#include "modules/layout/cell_map.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/layout/coverage.hpp"

namespace atrium::layout {

CellMap::CellMap(const StoreyCells& plan, double pixel) {
  constexpr double finest = 0.0125, most_squares = 1 << 27;
  pixel_ = pixel / (std::max(2, static_cast<int>(std::lround(pixel / (2 * finest)))) * 2);
  Eigen::AlignedBox2d box;
  for (const auto& v : plan.vertices) box.extend(v);
  low_ = box.min();
  while ((box.sizes() / pixel_).prod() > most_squares && pixel_ < pixel / 3) pixel_ *= 2;
  if ((box.sizes() / pixel_).prod() > most_squares)
    throw Error(fmt::format("what may be walls, floors and ceilings lies {:.0f} m apart: too far to look at it in "
                            "squares of {:.0f} mm",
                            box.sizes().maxCoeff(), 1000 * pixel),
                "leave out what lies far from the building (filter.crop, filter.outliers), or take larger squares "
                "(`pixel`)");
  width_ = static_cast<int>(std::ceil(box.sizes().x() / pixel_)) + 1;
  height_ = static_cast<int>(std::ceil(box.sizes().y() / pixel_)) + 1;
  cells_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1);
  for (std::size_t c = 0; c < plan.cells.size(); ++c) mark(plan, c);
}

std::int32_t CellMap::at(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d q = (p - low_) / pixel_;
  if (q.minCoeff() < 0 || q.x() >= width_ || q.y() >= height_) return -1;
  return cells_[static_cast<std::size_t>(q.y()) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(q.x())];
}

void CellMap::mark(const StoreyCells& plan, std::size_t c) {
  Eigen::AlignedBox2d box;
  for (const auto v : plan.cells[c].corners) box.extend(plan.vertices[v]);
  const auto place = [&](double v, int axis) { return static_cast<int>((v - low_[axis]) / pixel_); };
  for (int y = place(box.min().y(), 1); y <= std::min(height_ - 1, place(box.max().y(), 1)); ++y)
    for (int x = place(box.min().x(), 0); x <= std::min(width_ - 1, place(box.max().x(), 0)); ++x)
      if (is_inside(plan.vertices, plan.cells[c].corners, low_ + Eigen::Vector2d(x + 0.5, y + 0.5) * pixel_))
        cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] =
            static_cast<std::int32_t>(c);
}

}  // namespace atrium::layout
