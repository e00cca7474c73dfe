#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium {

/// Axis-aligned boxes in a tree (eight children to a node, along a Morton curve), to find those that meet. Boxes that
/// only touch meet too. Coordinates in any unit, finite.
class BoxTree {
 public:
  BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes, const Context& context);

  /// Calls visit(i) for every box that meets `box`, in the tree's order.
  template <class Visit>
  void meeting(const Eigen::AlignedBox3d& box, Visit visit) const {
    if (!order_.empty()) walk(levels_.size(), 0, box, visit);
  }

 private:
  template <class Visit>
  void walk(std::size_t level, std::size_t node, const Eigen::AlignedBox3d& box, Visit& visit) const {
    if (level == 0) return visit(order_[node]);
    const auto& below = level == 1 ? boxes_ : levels_[level - 2];
    const std::size_t end = std::min(below.size(), (node + 1) * fan);
    for (std::size_t i = node * fan; i < end; ++i)
      if (below[i].intersects(box)) walk(level - 1, i, box, visit);
  }
  static constexpr std::size_t fan = 8;
  std::vector<std::uint32_t> order_;
  std::vector<Eigen::AlignedBox3d> boxes_;                ///< in that order
  std::vector<std::vector<Eigen::AlignedBox3d>> levels_;  ///< each box holds `fan` of the level below; the last: one
};

}  // namespace atrium
