#include "modules/layout/enclosure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/layout/coverage.hpp"

namespace atrium::layout {
namespace {

constexpr double least_seen = 0.3;  // of an edge's length: less is no wall
constexpr double furthest = 20;     // metres
constexpr int directions = 16;

/// The walls of a storey in squares, seen from above.
class WallMap {
 public:
  explicit WallMap(const StoreyCells& storey)
      : storey_(storey),
        // Where ceilings were scanned, walls that enclose a room without one are as high: a garden's are not.
        least_top_(ceiling_scanned(storey) ? storey.floor_height + 0.9 * (storey.ceiling_height - storey.floor_height)
                                           : least_wall_top(storey)) {
    constexpr double finest = 0.1, most_squares = 1 << 24;
    for (const auto& v : storey.vertices) box_.extend(v);
    if (box_.isEmpty()) return;
    pixel_ = std::max(finest, std::sqrt(box_.volume() / most_squares));
    width_ = static_cast<int>(box_.sizes().x() / pixel_) + 1;
    height_ = static_cast<int>(box_.sizes().y() / pixel_) + 1;
    edge_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1);
    for (std::size_t e = 0; e < storey.edges.size(); ++e) {
      const CellEdge& edge = storey.edges[e];
      if (std::max(edge.face_left, edge.face_right) < least_seen || is_low(edge)) continue;
      const Eigen::Vector2d &a = storey.vertices[edge.from], &b = storey.vertices[edge.to];
      const int steps = static_cast<int>(2 * (b - a).norm() / pixel_) + 1;
      for (int i = 0; i <= steps; ++i)
        if (std::int32_t* square = at(a + (b - a) * (static_cast<double>(i) / steps)))
          *square = static_cast<std::int32_t>(e);
    }
  }

  /// Whether the first wall on the way looks towards `from`.
  bool faces(const Eigen::Vector2d& from, const Eigen::Vector2d& direction) {
    for (double length = 0; length < furthest; length += 0.7 * pixel_) {
      const std::int32_t* square = at(from + length * direction);
      if (square == nullptr) return false;
      if (*square < 0) continue;
      const CellEdge& edge = storey_.edges[static_cast<std::size_t>(*square)];
      const Eigen::Vector2d &a = storey_.vertices[edge.from], &b = storey_.vertices[edge.to];
      const Eigen::Vector2d along = b - a, way = from - a;
      const bool left = along.x() * way.y() - along.y() * way.x() > 0;
      return (left ? edge.face_left : edge.face_right) >= least_seen;
    }
    return false;
  }

 private:
  bool is_low(const CellEdge& edge) const { return std::max(edge.top_left, edge.top_right) < least_top_; }

  std::int32_t* at(const Eigen::Vector2d& p) {
    const auto x = static_cast<std::int64_t>(std::floor((p.x() - box_.min().x()) / pixel_));
    const auto y = static_cast<std::int64_t>(std::floor((p.y() - box_.min().y()) / pixel_));
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return nullptr;
    return &edge_[static_cast<std::size_t>(y * width_ + x)];
  }

  const StoreyCells& storey_;
  double least_top_;
  Eigen::AlignedBox2d box_;
  double pixel_ = 0.1;
  int width_ = 0, height_ = 0;
  std::vector<std::int32_t> edge_;
};

}  // namespace

void measure_enclosure(StoreyCells& storey) {
  WallMap walls(storey);
  for (LayoutCell& cell : storey.cells) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const auto c : cell.corners) middle += storey.vertices[c];
    middle /= static_cast<double>(cell.corners.size());
    int facing = 0;
    for (int k = 0; k < directions; ++k) {
      const double angle = (k + 0.5) * 2 * std::numbers::pi / directions;
      facing += walls.faces(middle, {std::cos(angle), std::sin(angle)}) ? 1 : 0;
    }
    cell.enclosed = static_cast<double>(facing) / directions;
  }
}

}  // namespace atrium::layout
