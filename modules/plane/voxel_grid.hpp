#pragma once
#include <array>
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

  const std::vector<Voxel>& voxels() const { return voxels_; }
  double edge() const { return edge_; }
  /// The voxel's number, or none.
  std::uint32_t find(const Voxel::Index& index) const {
    constexpr std::int32_t end = 1 << 21;
    for (const std::int32_t i : index)
      if (i < 0 || i >= end) return none;
    return table_[slot(key(index))].voxel;
  }
  Voxel::Index index_at(const Eigen::Vector3d& p) const;
  /// Calls visit(number) for the occupied ones of the 26 neighbours.
  template <class Visit>
  void visit_neighbours(std::uint32_t voxel, Visit visit) const {
    const Voxel::Index& at = voxels_[voxel].index;
    for (std::int32_t x = -1; x <= 1; ++x)
      for (std::int32_t y = -1; y <= 1; ++y)
        for (std::int32_t z = -1; z <= 1; ++z) {
          const std::uint32_t other = find({at[0] + x, at[1] + y, at[2] + z});
          if (other != none && other != voxel) visit(other);
        }
  }

 private:
  static std::uint64_t key(const Voxel::Index& index) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(index[0])) |
           static_cast<std::uint64_t>(static_cast<std::uint32_t>(index[1])) << 21U |
           static_cast<std::uint64_t>(static_cast<std::uint32_t>(index[2])) << 42U;
  }
  void measure(Voxel& voxel, const MortonOrder& order, const std::vector<std::int32_t>& owner,
               const Planarity& planarity) const;
  std::size_t slot(std::uint64_t key) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t s = (key * 0x9e3779b97f4a7c15ULL >> 32U) & mask;
    while (table_[s].voxel != none && table_[s].key != key) s = (s + 1) & mask;
    return s;
  }
  void hash();

  double edge_;
  std::int32_t centre_;  ///< index of the voxel whose low corner is the frame's origin
  std::vector<Voxel> voxels_;
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t voxel = none;
  };
  std::vector<Entry> table_;  ///< open addressing; its size is a power of two
};

}  // namespace atrium::plane
