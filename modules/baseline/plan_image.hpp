#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/types/floor_plan.hpp"

namespace atrium::baseline {

/// A picture of the plan, seen from above: squares of one size, each with a number.
struct PlanImage {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< least corner
  double pixel = 0.05;                            ///< side of a square, metres
  int width = 0, height = 0;
  std::vector<std::int32_t> values;

  PlanImage() = default;
  PlanImage(const Eigen::Vector2d& low_corner, double side, int columns, int rows)
      : low(low_corner), pixel(side), width(columns), height(rows) {
    values.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  std::int32_t& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  std::int32_t at(int x, int y) const {
    return holds(x, y)
               ? values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]
               : 0;
  }
};

/// 1 where a square within `radius` squares (along x and y) is not 0, else 0.
PlanImage dilated(const PlanImage& image, int radius);
/// 1 where all squares within `radius` are not 0; beyond the image all are 0.
PlanImage eroded(const PlanImage& image, int radius);

/// Numbers what hangs together over the squares' sides and is equal, from 1 by first square; 0 stays 0. `sizes`:
/// squares of each, from number 1 on.
PlanImage components(const PlanImage& image, std::vector<std::size_t>& sizes);

/// The longer side of the box around each component, in squares. `count`: how many there are.
std::vector<int> extents_of(const PlanImage& components, std::size_t count);

/// Sets the squares that are 0 to 1 where at most `most` of them hang together, none of them at the image's border.
void fill_holes(PlanImage& image, std::size_t most);

/// The borders of the squares with `value`: outlines counter-clockwise, then holes clockwise, corner by corner of the
/// squares. Needs one component.
PlanPolygon border_of(const PlanImage& image, std::int32_t value);

}  // namespace atrium::baseline
