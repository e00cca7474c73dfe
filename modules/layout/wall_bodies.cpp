#include "modules/layout/wall_bodies.hpp"

#include <algorithm>

namespace atrium::layout {
namespace {

constexpr double thickest = 0.3;  // metres

class Bodies {
 public:
  Bodies(const StoreyCells& storey, std::vector<std::int32_t>& rooms) : storey_(storey), rooms_(rooms) {}

  void clear() {
    constexpr double mostly = 0.5;  // of an edge's length that is a wall
    std::vector<std::size_t> cells;
    for (const auto& edge : storey_.edges) {
      const std::int32_t left = room_of(edge.left), right = room_of(edge.right);
      if (left < 0 || right < 0 || left == right) continue;
      if (edge.wall_left > mostly && edge.wall_right <= mostly) collect(edge, edge.right, cells);
      if (edge.wall_right > mostly && edge.wall_left <= mostly) collect(edge, edge.left, cells);
    }
    for (const auto cell : cells) rooms_[cell] = -1;
  }

 private:
  std::int32_t room_of(std::int32_t cell) const { return cell < 0 ? -1 : rooms_[static_cast<std::size_t>(cell)]; }

  /// In so thin a cell, squares at its rim show the floor of the next one.
  static bool is_unseen(const LayoutCell& cell) {
    constexpr double half = 0.5;  // of its area
    return std::max(cell.floor_cover, cell.ceiling_cover) < half;
  }

  /// All of the cell lies behind the edge, and no further than walls are thick.
  bool is_behind(const LayoutCell& cell, const Eigen::Vector2d& from, const Eigen::Vector2d& along,
                 double length) const {
    constexpr double slack = 0.01;  // metres
    return std::all_of(cell.corners.begin(), cell.corners.end(), [&](std::uint32_t corner) {
      const Eigen::Vector2d way = storey_.vertices[corner] - from;
      const double off = along.x() * way.y() - along.y() * way.x();
      return along.dot(way) > -slack && along.dot(way) < length + slack && std::abs(off) < thickest;
    });
  }

  void collect(const CellEdge& wall, std::int32_t behind, std::vector<std::size_t>& result) const {
    const Eigen::Vector2d from = storey_.vertices[wall.from], way = storey_.vertices[wall.to] - from;
    const double length = way.norm();
    if (!(length > 0)) return;
    std::vector<std::size_t> open{static_cast<std::size_t>(behind)};
    std::vector<std::size_t> seen;
    while (!open.empty()) {
      const std::size_t index = open.back();
      open.pop_back();
      const LayoutCell& cell = storey_.cells[index];
      if (std::find(seen.begin(), seen.end(), index) != seen.end() || rooms_[index] != room_of(behind) ||
          !is_unseen(cell) || !is_behind(cell, from, way / length, length))
        continue;
      seen.push_back(index);
      for (const auto e : cell.edges) {
        const CellEdge& edge = storey_.edges[e];
        if (&edge == &wall || edge.left < 0 || edge.right < 0) continue;
        open.push_back(static_cast<std::size_t>(edge.left) == index ? static_cast<std::size_t>(edge.right)
                                                                    : static_cast<std::size_t>(edge.left));
      }
    }
    result.insert(result.end(), seen.begin(), seen.end());
  }

  const StoreyCells& storey_;
  std::vector<std::int32_t>& rooms_;
};

}  // namespace

void clear_wall_bodies(const StoreyCells& storey, std::vector<std::int32_t>& rooms) { Bodies(storey, rooms).clear(); }

}  // namespace atrium::layout
