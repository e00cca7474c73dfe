#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "modules/io/key_table.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// Sums of the points of voxels, by the voxels' keys. Points are added one after the other: the sums are those of their
/// order.
class VoxelSums {
 public:
  /// Adds point i of the cloud to the voxel of that key.
  void add(std::uint64_t key, const Cloud& cloud, std::size_t i);
  std::size_t size() const { return keys_.size(); }
  std::uint64_t key(std::size_t voxel) const { return keys_.key(voxel); }
  std::uint64_t points(std::size_t voxel) const { return places_[voxel].count; }
  /// Puts a voxel's means at a place of the cloud, whose columns have room for it.
  void put(std::size_t voxel, Cloud& cloud, std::size_t place) const;

 private:
  struct Place {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::uint64_t count = 0;
  };
  struct Normal {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Vector3f first = Eigen::Vector3f::Zero();
  };

  std::int32_t most_frequent(std::size_t voxel) const;

  KeyTable keys_;  // whose numbers are the voxels' indices
  // By voxel; empty where the cloud has no such column.
  std::vector<Place> places_;
  std::vector<Normal> normals_;
  std::vector<std::array<std::uint64_t, 3>> colours_;
  std::vector<double> intensities_;
  std::vector<std::uint16_t> sources_;
  std::vector<std::int32_t> labels_;  // of the first point; those of other labels are counted aside
  std::unordered_map<std::uint32_t, std::vector<std::pair<std::int32_t, std::uint32_t>>> other_labels_;
};

}  // namespace atrium::io
