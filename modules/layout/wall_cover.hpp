#pragma once
#include <array>
#include <vector>

#include "modules/layout/prism_stacks.hpp"

namespace atrium::layout {

/// How far the walls on an edge reach, at one height, for those who look at them from one side.
struct WallReach {
  double floor = 0, ceiling = 0, share = 0;
};

/// The share of an edge on which a wall that looks to one side reaches up to the ceiling that stands before it.
class WallCover {
 public:
  WallCover(const PrismSpace& space, const PlanePrimitives& planes, const std::vector<Footprint>& footprints);
  /// `side` 0: for the prism of the cell left of the edge, by walls that look left; 1: right.
  double operator()(std::size_t edge, std::size_t side, std::size_t prism);

 private:
  double measure(const CellEdge& edge, std::size_t side, double floor, double ceiling) const;

  const PrismSpace& space_;
  const PlanePrimitives& planes_;
  const std::vector<Footprint>& footprints_;
  std::vector<std::array<std::vector<WallReach>, 2>> known_;
};

}  // namespace atrium::layout
