#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "modules/types/cloud.hpp"

namespace atrium::layout {

/// The points of a cloud in cubes, to find those in a box and to look along straight ways between them.
///
/// What a point occupies grows with the distance of the points around it, so that surfaces are closed where the scan is
/// sparse; points that are nearly alone occupy nothing.
class FreeSpace {
 public:
  /// `voxel`: edge of what a point occupies at least, metres. Points out of `region` are left out: memory and time grow
  /// with it.
  FreeSpace(const Cloud& cloud, double voxel, const Eigen::AlignedBox3d& region);

  /// Calls visit(point) for all points in the box and some around it.
  template <class Visit>
  void each_point_in(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    const auto place = [&](const Eigen::Vector3d& p) -> Eigen::Array<std::int64_t, 3, 1> {
      return ((p - low_) / bucket_edge).array().floor().template cast<std::int64_t>().max(0).min(buckets_ - 1);
    };
    const auto first = place(box.min()), last = place(box.max());
    for (std::int64_t z = first[2]; z <= last[2]; ++z)
      for (std::int64_t y = first[1]; y <= last[1]; ++y)
        for (std::int64_t x = first[0]; x <= last[0]; ++x) {
          const std::size_t b = bucket(x, y, z);
          for (std::uint32_t i = begin_[b]; i < begin_[b + 1]; ++i)
            visit(cloud_.points[order_[i]].template cast<double>());
        }
  }
  /// Whether no voxel on the way is occupied. The end may stand in one.
  bool is_free(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  bool is_occupied(const Eigen::Vector3d& place) const;

 private:
  static constexpr double bucket_edge = 0.5;

  void occupy(const Eigen::Vector3d& place, double reach);
  std::size_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * buckets_[1] + y) * buckets_[0] + x);
  }

  const Cloud& cloud_;
  double voxel_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  Eigen::Array<std::int64_t, 3, 1> size_{0, 0, 0};     // in voxels
  Eigen::Array<std::int64_t, 3, 1> buckets_{0, 0, 0};  // of points
  std::vector<std::uint64_t> occupied_;                // a bit per voxel
  std::vector<std::uint32_t> begin_, order_;           // the points of each bucket
};

}  // namespace atrium::layout
