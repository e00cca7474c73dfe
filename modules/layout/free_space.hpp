#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "modules/types/cloud.hpp"

namespace atrium::layout {

/// The points of a cloud in cubes, to find those in a box and to look along straight ways between them.
class FreeSpace {
 public:
  /// `voxel`: edge of what a point occupies, metres.
  FreeSpace(const Cloud& cloud, double voxel);

  /// Calls visit(point) for all points in the box and some around it.
  void each_point_in(const Eigen::AlignedBox3d& box, const std::function<void(const Eigen::Vector3d&)>& visit) const;
  /// Whether no voxel on the way is occupied. Both ends may stand in one.
  bool is_free(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  bool is_occupied(const Eigen::Vector3d& place) const;

 private:
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
