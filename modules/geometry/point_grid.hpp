#pragma once
#include <Eigen/Core>
#include <array>
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

  /// The cell at a place (any numbers), or `none` where there is no point.
  std::uint32_t find(std::int32_t x, std::int32_t y, std::int32_t z) const;
  /// The 27 cells around and in the middle (`none` where empty), x fastest; the cell itself stands at 13.
  std::array<std::uint32_t, 27> neighbourhood(const Cell& cell) const;
  /// The place of a position; not necessarily within the extent.
  std::array<std::int64_t, 3> place(const Eigen::Vector3d& position) const;

 private:
  // 4 × 4 × 4 cells: which of them exist, and the number of the first.
  struct Block {
    std::uint64_t key = 0, occupied = 0;
    std::uint32_t first = none;
  };
  void span(const std::vector<Eigen::Vector3f>& points, const Context& context);
  std::uint64_t key(const Eigen::Vector3f& point) const;
  std::vector<std::uint64_t> sort(const std::vector<Eigen::Vector3f>& points, const Context& context);
  std::vector<std::uint64_t> sort_wide(const std::vector<Eigen::Vector3f>& points, const Context& context);
  std::vector<std::uint64_t> make_cells(const std::vector<std::uint64_t>& sorted_keys, const Context& context);
  void make_blocks(const std::vector<std::uint64_t>& cell_keys);
  std::size_t slot(std::uint64_t block_key) const;

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
};

}  // namespace atrium
