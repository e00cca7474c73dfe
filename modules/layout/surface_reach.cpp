#include "modules/layout/surface_reach.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/layout/coverage.hpp"
#include "modules/layout/wall_lines.hpp"

namespace atrium::layout {
namespace {

constexpr double reach_square = 0.25;  // metres

}  // namespace

SurfaceReach::SurfaceReach(const PlanePrimitives& planes, const CellSurface& surface, double reach) {
  Eigen::AlignedBox2d box;
  const auto primitives = primitives_of(surface);
  const auto each = [&](auto visit) {
    for (const auto p : primitives)
      for (const auto i : planes.primitives[static_cast<std::size_t>(p)].inliers)
        visit(Eigen::Vector2d(planes.cloud->points[i].head<2>().cast<double>()));
  };
  each([&](const Eigen::Vector2d& p) { box.extend(p); });
  const int steps = static_cast<int>(std::ceil(reach / reach_square));
  low_ = (box.min() / reach_square).array().floor() * reach_square - (steps + 1) * reach_square;
  width_ = column(box.max().x()) + steps + 2;
  height_ = row(box.max().y()) + steps + 2;
  seen_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  each([&](const Eigen::Vector2d& p) { seen_[index(column(p.x()), row(p.y()))] = 1; });
  near_ = seen_;
  for (int pass = 0; pass < steps; ++pass) grow();
}

bool SurfaceReach::touches(const StoreyCells& plan, const LayoutCell& cell, bool seen) const {
  const std::vector<std::uint8_t>& mask = seen ? seen_ : near_;
  Eigen::AlignedBox2d box;
  for (const auto c : cell.corners) box.extend(plan.vertices[c]);
  if (at(mask, middle_of(plan, cell))) return true;
  const int x1 = std::min(width_ - 1, column(box.max().x())), y1 = std::min(height_ - 1, row(box.max().y()));
  for (int y = std::max(0, row(box.min().y())); y <= y1; ++y)
    for (int x = std::max(0, column(box.min().x())); x <= x1; ++x)
      if (mask[index(x, y)] != 0 &&
          is_inside(plan.vertices, cell.corners, low_ + Eigen::Vector2d(x + 0.5, y + 0.5) * reach_square))
        return true;
  return false;
}

int SurfaceReach::column(double x) const { return static_cast<int>(std::floor((x - low_.x()) / reach_square)); }
int SurfaceReach::row(double y) const { return static_cast<int>(std::floor((y - low_.y()) / reach_square)); }

bool SurfaceReach::at(const std::vector<std::uint8_t>& mask, const Eigen::Vector2d& p) const {
  const int x = column(p.x()), y = row(p.y());
  return x >= 0 && y >= 0 && x < width_ && y < height_ && mask[index(x, y)] != 0;
}

void SurfaceReach::grow() {
  const std::vector<std::uint8_t> before = near_;
  for (int y = 1; y + 1 < height_; ++y)
    for (int x = 1; x + 1 < width_; ++x)
      if (before[index(x, y)] == 0)
        near_[index(x, y)] =
            before[index(x - 1, y)] | before[index(x + 1, y)] | before[index(x, y - 1)] | before[index(x, y + 1)];
}

}  // namespace atrium::layout
