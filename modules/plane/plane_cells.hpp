#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Square cells in a plane, on which connected components of its points are found (Schnabel et al., 4.4). Points nearer
/// to each other than `reach` are connected: the paper's bitmap would bridge gaps of up to twice its cells or not,
/// depending on where they lie. Only occupied cells take memory, so that neither the extent of the scene nor a far
/// outlier matters.
class PlaneCells {
 public:
  PlaneCells() = default;
  PlaneCells(const Eigen::Vector3d& normal, double reach);

  /// The number of the point's cell, made if it is new. Numbers count up from 0.
  std::uint32_t add(const Eigen::Vector3f& p);
  bool contains(const Eigen::Vector3f& p) const { return find(index(position(p))) != absent; }
  std::size_t size() const { return indices_.size(); }

  /// For each cell the number of its component.
  std::vector<std::uint32_t> components() const;
  /// The chosen cells and those that touch them.
  PlaneCells dilated(const std::vector<bool>& chosen) const;

 private:
  static constexpr std::uint32_t absent = 0xffffffff;
  static constexpr std::int32_t tile_bits = 4;  ///< tiles of 16 × 16 cells
  static constexpr std::size_t tile_cells = 1U << (2 * tile_bits);
  struct Index {
    std::int32_t u, v;
  };
  /// A point for its surroundings of 1/8 of a cell: at most 64 in a cell however many points there are.
  struct Sample {
    Eigen::Vector2f at;  ///< in cells
    std::uint32_t next;  ///< of the same cell
  };
  Eigen::Vector2f position(const Eigen::Vector3f& p) const;
  static Index index(const Eigen::Vector2f& at);
  static std::size_t place_in_tile(Index i);
  static std::uint64_t tile_key(Index i);
  bool linked(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t insert(Index i);
  std::uint32_t find(Index i) const;
  std::size_t slot(std::uint64_t tile) const;
  void grow();

  Eigen::Vector3f u_ = Eigen::Vector3f::UnitX();  ///< axes in the plane, in cells
  Eigen::Vector3f v_ = Eigen::Vector3f::UnitY();
  std::vector<Index> indices_;             ///< of the cells, in the order in which they were made
  std::vector<std::uint32_t> cells_;       ///< numbers of cells, tile by tile
  std::vector<std::uint64_t> tile_keys_;   ///< in the order in which the tiles were made
  std::vector<std::uint32_t> tile_table_;  ///< open addressing: numbers of tiles; its size is a power of two
  std::vector<std::uint32_t> first_;       ///< per cell: its first sample
  std::vector<std::uint64_t> filled_;      ///< per cell: which of its 8 × 8 parts have a sample
  std::vector<Sample> samples_;
};

}  // namespace atrium::plane
