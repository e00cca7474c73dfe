#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/geometry/surface_pieces.hpp"

namespace atrium {

/// Pieces of a scan as seen along an axis, in metres: columns of the plan, each sorted by height, and the heights at
/// which much of what is level lies (floors and ceilings).
class UprightView {
 public:
  enum class Kind : std::uint8_t { level, wall, other, rough };  ///< other: on a plane that is neither; rough: on none
  struct Item {
    std::uint32_t block = 0;   ///< square metre of the plan (about) that its column is in
    std::uint32_t column = 0;  ///< number of its column
    float height = 0;          ///< metres along the axis
    Kind kind = Kind::other;
    bool large = false;  ///< on a level of much area that is there in its block
    bool main =
        false;  ///< the same, and that level is a floor or a ceiling there: on a main level that is there in its block
  };
  struct Level {
    double height = 0, area = 0;
    bool hidden = false;       ///< little of it is seen, but the scan ends there
    std::vector<char> blocks;  ///< by block: whether the level is there or in a neighbouring block
  };

  UprightView(const SurfacePieces& pieces, const Eigen::Vector3d& axis, double scale);

  const std::vector<Item>& items() const { return items_; }               ///< by column, then by height
  const std::vector<std::uint32_t>& columns() const { return columns_; }  ///< where each begins, and the end
  const std::vector<Level>& levels() const { return levels_; }            ///< rising
  /// The column so many rows and columns of the plan further; -1: nothing is there.
  std::int64_t neighbour(std::uint32_t column, int rows, int columns) const;
  /// Where a column is in plan, metres from the plan's corner.
  Eigen::Vector2d place_of(std::uint32_t column) const;
  double piece() const { return piece_; }
  double level_area() const { return level_area_; }
  /// The number e^H of heights that what is level is spread over, by area (H: entropy over steps of 10 cm).
  double spread() const { return spread_; }
  /// The nearest main level in this block that is at least 0.15 m below (or above) a height; null: none.
  const Level* below(std::uint32_t block, double height) const;
  const Level* above(std::uint32_t block, double height) const;

 private:
  void place(const SurfacePieces& pieces, const Eigen::Vector3d& axis, double scale);
  void find_levels();
  void add_ends();
  void mark_levels();
  void drop_furniture();

  std::vector<Item> items_;
  std::vector<std::uint32_t> columns_;
  std::vector<std::int64_t> keys_;  // by column: its row times wide_ and its place in the row
  std::int64_t wide_ = 1;
  double cell_ = 1;
  std::vector<Level> levels_;
  std::uint32_t block_rows_ = 0, block_columns_ = 0;
  double piece_ = 0, level_area_ = 0, spread_ = 1;
};

}  // namespace atrium
