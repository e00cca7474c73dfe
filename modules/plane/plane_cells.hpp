#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

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
  std::uint32_t add(const Eigen::Vector3f& p);
  std::size_t size() const { return indices_.size(); }
  CellFrame::Index index(std::uint32_t cell) const { return indices_[cell]; }

  /// For each cell the number of its component: that of the component's first cell.
  std::vector<std::uint32_t> components() const;
  /// The chosen cells and those that touch them.
  CellSet dilated(const std::vector<bool>& chosen) const;

 private:
  static constexpr std::uint32_t absent = TileTable::absent;
  /// A point for its surroundings of 1/8 of a cell: at most 64 in a cell however many points there are.
  struct Sample {
    Eigen::Vector2f at;  ///< in cells
    std::uint32_t next;  ///< of the same cell
  };
  class Neighbours;
  class Forest;
  std::uint32_t insert(CellFrame::Index i);
  bool linked(std::uint32_t a, std::uint32_t b) const;
  void link(std::uint32_t cell, std::uint32_t other, Forest& forest) const;
  /// Calls visit(cell, its neighbours) for each cell, tile by tile.
  template <class Visit>
  void visit_cells(Visit visit) const;

  CellFrame frame_;
  TileTable tiles_;
  std::uint64_t last_key_ = 0;  ///< the last point's tile: the next one is mostly in it, too
  std::uint32_t last_tile_ = absent;
  std::vector<CellFrame::Index> indices_;  ///< of the cells, in the order in which they were made
  std::vector<std::uint32_t> cells_;       ///< numbers of cells, tile by tile
  std::vector<std::uint32_t> first_;       ///< per cell: its first sample
  std::vector<std::uint64_t> filled_;      ///< per cell: which of its 8 × 8 parts have a sample
  std::vector<Sample> samples_;
};

}  // namespace atrium::plane
