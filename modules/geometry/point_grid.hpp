#pragma once
#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium {

/// Points sorted into cubic cells: the cells stand along a Morton curve, so that neighbours in space are near in
/// memory, and the points of a cell by ascending index. Only cells that hold a point exist. Cells are aligned to
/// multiples of their size from the points' local zero: adding points moves no cell.
///
/// The grid spans at most 2²⁰ cells along each axis (20 km of 2 cm cells). If the points reach further, it stands
/// around their median, and what lies outside (wild outliers) is in no cell: it comes last in points() and order(),
/// from inside() on.
class PointGrid {
 public:
  struct Cell {
    std::int32_t x, y, z;      ///< place in the grid, from 0
    std::uint32_t begin, end;  ///< its points: positions in points() and order()
    std::uint32_t size() const { return end - begin; }
  };
  static constexpr std::uint32_t none = 0xffffffffU;

  /// Fewer than 2³² - 1 finite points; cell_size in metres, above 0. Throws Error if either does not hold. Without
  /// lookup, find() and neighbourhood() find nothing.
  enum class Lookup { no, yes };
  PointGrid(const std::vector<Eigen::Vector3f>& points, double cell_size, const Context& context,
            Lookup lookup = Lookup::yes);

  double cell_size() const { return cell_size_; }
  const std::vector<Cell>& cells() const { return cells_; }
  /// The points in the order of the cells, and for each its index in the cloud.
  const std::vector<Eigen::Vector3f>& points() const { return points_; }
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// How many of them lie in cells.
  std::size_t inside() const { return inside_; }
  /// The middle of a cell, in the points' frame.
  Eigen::Vector3d centre(const Cell& cell) const {
    return (base_ + Eigen::Vector3d(cell.x + 0.5, cell.y + 0.5, cell.z + 0.5)) * cell_size_;
  }
  /// The low corner of the cell (0, 0, 0), in the points' frame.
  Eigen::Vector3d corner() const { return base_ * cell_size_; }
  /// Number of cells along each axis.
  const std::array<std::int32_t, 3>& extent() const { return extent_; }

  /// 4 × 4 × 4 cells: which of them exist, and the number of the first.
  struct Block {
    std::uint64_t key = 0, occupied = 0;
    std::uint32_t first = none;
    bool empty() const { return first == none; }
    /// Of the places in the grid that lie in the block; `none` where there is no point.
    std::uint32_t cell(std::int64_t x, std::int64_t y, std::int64_t z) const {
      const auto low = static_cast<std::uint64_t>((x & 1) | (y & 1) << 1 | (z & 1) << 2);
      const auto high = static_cast<std::uint64_t>((x & 2) << 2 | (y & 2) << 3 | (z & 2) << 4);
      const std::uint64_t bit = std::uint64_t{1} << (low | high);
      if ((occupied & bit) == 0) return none;
      return first + static_cast<std::uint32_t>(std::popcount(occupied & (bit - 1)));
    }
  };
  /// The block around the place of a cell within the extent, an empty one where there is no point.
  const Block& block(std::int64_t x, std::int64_t y, std::int64_t z) const {
    static constexpr Block no_point;
    const std::size_t bit = map_bit(x, y, z);
    if ((map_[bit >> 6U] >> (bit & 63U) & 1U) == 0) return no_point;
    const std::uint64_t key = spread_[0][static_cast<std::size_t>(x)] | spread_[1][static_cast<std::size_t>(y)] |
                              spread_[2][static_cast<std::size_t>(z)];
    return blocks_[slot(key >> 6U)];
  }
  /// The cell at a place (any numbers), or `none` where there is no point.
  std::uint32_t find(std::int32_t x, std::int32_t y, std::int32_t z) const;
  /// The 27 cells around and in the middle (`none` where empty), x fastest; the cell itself stands at 13.
  std::array<std::uint32_t, 27> neighbourhood(const Cell& cell) const;
  /// The place of a position; not necessarily within the extent.
  std::array<std::int64_t, 3> place(const Eigen::Vector3d& position) const;

 private:
  void span(const std::vector<Eigen::Vector3f>& points, const Context& context);
  std::uint64_t key(const Eigen::Vector3f& point) const;
  std::vector<std::uint64_t> sort(const std::vector<Eigen::Vector3f>& points, const Context& context);
  std::vector<std::uint64_t> sort_wide(const std::vector<Eigen::Vector3f>& points, const Context& context);
  std::vector<std::uint64_t> make_cells(const std::vector<std::uint64_t>& sorted_keys, const Context& context);
  void make_blocks(const std::vector<std::uint64_t>& cell_keys);
  void make_map();
  std::size_t map_bit(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const auto cube = [&](std::int64_t i) { return static_cast<std::size_t>(i) >> map_shift_; };
    return (cube(z) * map_height_ + cube(y)) * map_width_ + cube(x);
  }
  std::size_t slot(std::uint64_t block_key) const {
    const std::size_t mask = blocks_.size() - 1;
    std::size_t at = static_cast<std::size_t>((block_key * 0x9e3779b97f4a7c15ULL) >> 32U) & mask;
    while (blocks_[at].first != none && blocks_[at].key != block_key) at = (at + 1) & mask;
    return at;
  }

  double cell_size_, inverse_;
  Eigen::Vector3d base_ = Eigen::Vector3d::Zero();  // the corner, in cells
  std::array<std::int32_t, 3> extent_{0, 0, 0};
  std::array<std::vector<std::uint64_t>, 3> spread_;  // a coordinate's bits at their places in the Morton key
  unsigned key_bits_ = 0;
  std::size_t inside_ = 0;
  std::vector<Cell> cells_;
  std::vector<Eigen::Vector3f> points_;
  std::vector<std::uint32_t> order_;
  std::vector<Block> blocks_;  // open addressing, a power of two long
  // A bit for each cube of 2^map_shift_ cells that has a point: most of space has none, and this fits into the cache.
  std::vector<std::uint64_t> map_ = std::vector<std::uint64_t>(1, 0);
  unsigned map_shift_ = 31;  // without lookup one cube, without a point
  std::size_t map_width_ = 0, map_height_ = 0;
};

}  // namespace atrium
