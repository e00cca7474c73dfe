#pragma once
#include <vector>

#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// The cell at each place of a plan, in squares finer than coverage is counted in. Errors: a plan so wide that these
/// would fill the memory.
class CellMap {
 public:
  CellMap(const StoreyCells& plan, double pixel);
  /// −1: outside of the plan.
  std::int32_t at(const Eigen::Vector2d& p) const;

 private:
  void mark(const StoreyCells& plan, std::size_t c);

  double pixel_ = 0;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0, height_ = 0;
  std::vector<std::int32_t> cells_;
};

}  // namespace atrium::layout
