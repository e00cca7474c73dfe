#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/moments.hpp"
#include "modules/plane/point_octree.hpp"

namespace atrium::plane {

/// The points of a cubic cell.
struct Voxel {
  using Index = std::array<std::int32_t, 3>;
  Index index{};
  std::uint32_t begin = 0, end = 0;                  ///< places in the order, owned points included
  Moments moments;                                   ///< of the points that are free, in the columns' frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the plane through them; sign arbitrary
  double residual = 0;                               ///< RMS distance from it, metres
  bool planar = false;
};

/// The occupied voxels of a cloud, along the Morton curve of its order: each is a run of points.
class VoxelGrid {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Voxels of edge order cell · 2^level over the points whose owner is negative. A voxel is planar if it has at least
  /// `min_points` points, spread in two directions and at most `max_residual` (RMS) from a plane.
  struct Planarity {
    std::size_t min_points = 5;
    double max_residual = 0.01;
  };
  VoxelGrid(const MortonOrder& order, double cell, std::uint32_t level, const std::vector<std::int32_t>& owner,
            const Planarity& planarity, const Context& context);
  /// The same for other owners. No owned point may have become free: voxels with as many free points as before are left
  /// as they are.
  void update(const MortonOrder& order, const std::vector<std::int32_t>& owner, const Planarity& planarity,
              const Context& context);

  /// Planar from now on are only those that are at most this far from their plane (RMS, metres).
  void limit_residual(double max_residual) {
    for (Voxel& voxel : voxels_) voxel.planar = voxel.planar && voxel.residual <= max_residual;
  }

  const std::vector<Voxel>& voxels() const { return voxels_; }
  double edge() const { return edge_; }
  /// The voxel's number, or none.
  std::uint32_t find(const Voxel::Index& index) const {
    return in_block(block(index[0] >> 2, index[1] >> 2, index[2] >> 2), place(index[0], index[1], index[2]));
  }
  Voxel::Index index_at(const Eigen::Vector3d& p) const;
  /// Calls visit(number) for the occupied ones of the 26 neighbours.
  template <class Visit>
  void visit_neighbours(std::uint32_t voxel, Visit visit) const {
    const Voxel::Index& at = voxels_[voxel].index;
    const Voxel::Index low{(at[0] - 1) >> 2, (at[1] - 1) >> 2, (at[2] - 1) >> 2};
    std::array<Block, 8> blocks;  // that a neighbour can be in
    for (std::int32_t i = 0; i < 8; ++i) {
      const Voxel::Index b{low[0] + (i & 1), low[1] + (i >> 1 & 1), low[2] + (i >> 2)};
      if (4 * b[0] <= at[0] + 1 && 4 * b[1] <= at[1] + 1 && 4 * b[2] <= at[2] + 1)
        blocks[static_cast<std::size_t>(i)] = block(b[0], b[1], b[2]);
    }
    for (std::int32_t x = at[0] - 1; x <= at[0] + 1; ++x)
      for (std::int32_t y = at[1] - 1; y <= at[1] + 1; ++y)
        for (std::int32_t z = at[2] - 1; z <= at[2] + 1; ++z) {
          const std::int32_t i = ((x >> 2) - low[0]) | ((y >> 2) - low[1]) << 1 | ((z >> 2) - low[2]) << 2;
          const std::uint32_t other = in_block(blocks[static_cast<std::size_t>(i)], place(x, y, z));
          if (other != none && other != voxel) visit(other);
        }
  }

 private:
  /// 4 × 4 × 4 voxels: which of them exist, a bit each in Morton order, and the number of the first.
  struct Block {
    std::uint64_t key = 0, occupied = 0;
    std::uint32_t first = none;
  };
  /// The place in its block.
  static std::uint32_t place(std::int32_t x, std::int32_t y, std::int32_t z) {
    constexpr std::array<std::uint32_t, 4> spread{0, 1, 8, 9};
    return spread[static_cast<std::size_t>(x & 3)] | spread[static_cast<std::size_t>(y & 3)] << 1U |
           spread[static_cast<std::size_t>(z & 3)] << 2U;
  }
  static std::uint32_t in_block(const Block& block, std::uint32_t place) {
    if ((block.occupied >> place & 1U) == 0) return none;
    return block.first + static_cast<std::uint32_t>(std::popcount(block.occupied & ((std::uint64_t{1} << place) - 1)));
  }
  static std::uint64_t key(std::int32_t x, std::int32_t y, std::int32_t z) {
    return static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) << 21U | static_cast<std::uint64_t>(z) << 42U;
  }
  /// The block at a place, an empty one where there is none.
  Block block(std::int32_t x, std::int32_t y, std::int32_t z) const {
    constexpr std::int32_t end = 1 << 19;
    if (x < 0 || y < 0 || z < 0 || x >= end || y >= end || z >= end) return {};
    return table_[slot(key(x, y, z))];
  }
  void measure(Voxel& voxel, const MortonOrder& order, const std::vector<std::int32_t>& owner,
               const Planarity& planarity) const;
  std::size_t slot(std::uint64_t key) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t s = (key * 0x9e3779b97f4a7c15ULL >> 32U) & mask;
    while (table_[s].first != none && table_[s].key != key) s = (s + 1) & mask;
    return s;
  }
  void make_blocks();

  double edge_;
  double shift_;         ///< of the order
  std::int32_t centre_;  ///< index of the voxel whose low corner is the frame's origin
  std::vector<Voxel> voxels_;
  std::vector<Block> table_;  ///< open addressing; its size is a power of two
};

}  // namespace atrium::plane
