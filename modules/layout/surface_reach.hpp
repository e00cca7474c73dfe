#pragma once
#include <vector>

#include "modules/types/cell_complex.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

/// Where a surface was seen, and what lies near (so far in steps along the axes), in squares of 0.25 m.
class SurfaceReach {
 public:
  /// `reach`: how far from where it was seen a place is near it, metres.
  SurfaceReach(const PlanePrimitives& planes, const CellSurface& surface, double reach);
  /// Whether some place of a cell is one where it was seen, or near one.
  bool touches(const StoreyCells& plan, const LayoutCell& cell, bool seen) const;

 private:
  int column(double x) const;
  int row(double y) const;
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  bool at(const std::vector<std::uint8_t>& mask, const Eigen::Vector2d& p) const;
  void grow();

  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> seen_, near_;
};

}  // namespace atrium::layout
