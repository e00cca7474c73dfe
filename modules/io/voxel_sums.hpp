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
/// order. 41 to 47 bytes a voxel; 12 more with colours, 4 with labels, 40 with normals, 8 with intensities, 2 with
/// sources, and 17 to 23 for each label in it that is not its first point's.
///
/// When all points are there, the means are taken column by column, points last, and each column given back.
class VoxelSums {
 public:
  /// Adds point i of the cloud to the voxel of that key. At most 2³² - 1 points.
  void add(std::uint64_t key, const Cloud& cloud, std::size_t i);
  /// No more points come.
  void close();

  std::size_t size() const { return places_.size(); }
  std::uint64_t key(std::size_t voxel) const { return keys_.key(voxel); }
  std::uint32_t points(std::size_t voxel) const { return places_[voxel].count; }

  Eigen::Vector3f point(std::size_t voxel) const;
  Eigen::Vector3f normal(std::size_t voxel) const;
  Colour colour(std::size_t voxel) const;
  float intensity(std::size_t voxel) const;
  std::uint16_t source(std::size_t voxel) const { return sources_[voxel]; }
  std::int32_t label(std::size_t voxel) const { return labels_[voxel]; }

  void drop_keys() { keys_ = {}; }
  void drop_points() { places_.clear(); }
  void drop_normals() { normals_.clear(); }
  void drop_colours() { colours_.clear(); }
  void drop_intensities() { intensities_.clear(); }
  void drop_sources() { sources_.clear(); }
  void drop_labels() { labels_.clear(); }

 private:
  struct [[gnu::packed, gnu::aligned(4)]] Place {
    double x = 0, y = 0, z = 0;
    std::uint32_t count = 0;
  };
  struct Normal {
    std::array<double, 3> sum{};
    std::array<float, 3> first{};
  };

  void add_column_entries(const Cloud& cloud, std::size_t i);
  void add_colour(std::uint32_t voxel, const Colour& colour);
  void count_label(std::uint32_t voxel, std::int32_t label);
  void choose_labels();

  KeyTable keys_;  // whose numbers are the voxels' indices
  // By voxel; empty where the cloud has no such column.
  PieceVector<Place> places_;
  PieceVector<Normal> normals_;
  PieceVector<std::array<std::uint32_t, 3>> colours_;
  std::unordered_map<std::uint64_t, std::uint32_t> colour_carries_;  // of 3 · voxel + channel: 2³² are in the sum
  PieceVector<double> intensities_;
  PieceVector<std::uint16_t> sources_;
  PieceVector<std::int32_t> labels_;         // of the first point, when all are there the most frequent
  KeyTable other_labels_;                    // voxel and label
  PieceVector<std::uint32_t> other_counts_;  // how many points have it
};

}  // namespace atrium::io
