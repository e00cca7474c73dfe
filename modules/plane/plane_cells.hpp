#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/plane/cell_set.hpp"

namespace atrium::plane {

/// Square cells in a plane, on which connected components of its points are found (Schnabel et al., 4.4). Points nearer
/// to each other than `reach` are connected: the paper's bitmap would bridge gaps of up to twice its cells or not,
/// depending on where they lie. Only occupied tiles of cells take memory, so that neither the extent of the scene nor a
/// far outlier matters.
class PlaneCells {
 public:
  PlaneCells(const Eigen::Vector3d& normal, double reach);

  /// The number of the point's cell, made if it is new. Numbers count up from 0.
  std::uint32_t add(const Eigen::Vector3f& p) { return add(position(p)); }
  std::uint32_t add(const Eigen::Vector2f& at);
  /// In the plane, in cells.
  Eigen::Vector2f position(const Eigen::Vector3f& p) const { return frame_.position(p); }
  std::size_t size() const { return indices_.size(); }
  double cell_area() const { return cell_area_; }  ///< square metres
  CellFrame::Index index(std::uint32_t cell) const { return indices_[cell]; }

  /// For each cell the number of its component: that of the component's first cell.
  std::vector<std::uint32_t> components(const Context& context) const;
  /// The chosen cells and those that touch them.
  CellSet dilated(const std::vector<bool>& chosen) const;

 private:
  static constexpr std::uint32_t absent = TileTable::absent;
  /// A point for its surroundings of 1/8 of a cell: at most 64 in a cell however many points there are.
  struct Sample {
    Eigen::Vector2f at;  ///< in cells
    std::uint32_t next;  ///< of the same cell
  };
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  static constexpr std::size_t tile_edge = 1U << CellFrame::tile_bits;
  class Neighbours;
  class Forest;
  std::uint32_t insert(CellFrame::Index i);
  bool linked(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t at(std::size_t tile, CellFrame::Index i) const {
    return cells_[tile * CellFrame::tile_cells + CellFrame::place_in_tile(i)];
  }
  /// Calls visit(cell, other, tile of the other) for the cells of the tiles [begin, end) and those a step away.
  template <class Steps, class Visit>
  void visit_pairs(std::size_t begin, std::size_t end, const Steps& steps, Visit visit) const;
  void join_near(Forest& forest, const Context& context) const;
  void join_far(Forest& forest, const Context& context) const;

  CellFrame frame_;
  double cell_area_;
  TileTable tiles_;
  std::uint64_t last_key_ = 0;  ///< the last point's tile: the next one is mostly in it, too
  std::uint32_t last_tile_ = absent;
  std::vector<CellFrame::Index> indices_;  ///< of the cells, in the order in which they were made
  std::vector<std::uint32_t> cells_;       ///< numbers of cells, tile by tile
  std::vector<CellSet::Rows> occupied_;    ///< per tile
  std::vector<std::uint32_t> first_;       ///< per cell: its first sample
  std::vector<std::uint64_t> filled_;      ///< per cell: which of its 8 × 8 parts have a sample
  std::vector<Sample> samples_;
};

}  // namespace atrium::plane
