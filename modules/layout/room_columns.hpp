#pragma once
#include <algorithm>
#include <vector>

#include "modules/layout/face_grid.hpp"

namespace atrium::layout {

/// A room seen from above, in squares of 25 cm whose corners are multiples of that: each is a column from floor to
/// ceiling.
struct RoomColumns {
  static constexpr double square = 0.25;  ///< metres
  struct Column {
    bool inside = false;
    double floor = 0, ceiling = 0;  ///< heights, metres
    bool floor_seen = false, ceiling_seen = false;
    bool apart = false;         ///< far enough from the outline that a wall there is none of the room's own
    std::uint64_t stacked = 0;  ///< a bit per 25 cm of height: points of upright planes
    bool other_floor = false, other_ceiling = false;  ///< a level plane between floor and ceiling, far from both
    bool low_level = false;                           ///< one at the height of furniture

    double height() const { return ceiling - floor; }
    int levels() const { return std::clamp(static_cast<int>(height() / square), 1, 64); }
  };
  Eigen::Vector2i low = Eigen::Vector2i::Zero();
  int width = 0, height = 0;
  std::vector<Column> columns;

  static Eigen::Vector2i square_of(const Eigen::Vector2d& p) { return (p / square).array().floor().cast<int>(); }
  Eigen::Vector2d centre(int x, int y) const {
    return (Eigen::Vector2d(low.x() + x, low.y() + y) + Eigen::Vector2d::Constant(0.5)) * square;
  }
  /// Null outside of the room.
  Column* at(const Eigen::Vector2i& place) {
    const Eigen::Vector2i p = place - low;
    if (p.x() < 0 || p.y() < 0 || p.x() >= width || p.y() >= height) return nullptr;
    Column& column =
        columns[static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(width) + static_cast<std::size_t>(p.x())];
    return column.inside ? &column : nullptr;
  }
  const Column* at(const Eigen::Vector2i& place) const { return const_cast<RoomColumns*>(this)->at(place); }
};

/// The columns of all rooms, with what the points of the planes say.
std::vector<RoomColumns> room_columns(const Building& building, const PlanePrimitives& planes,
                                      const std::vector<FaceGrid>& grids);

}  // namespace atrium::layout
