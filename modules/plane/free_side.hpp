#pragma once
#include <cstdint>
#include <vector>

#include "modules/plane/assignment.hpp"
#include "modules/plane/voxel_grid.hpp"

namespace atrium::plane {

/// Turns planes to the side from which their surfaces were seen, for clouds without normals.
///
/// With sensors: to the side where the sensors of its points stood. Without: to the side with room in front of it, by
/// looking along the normal both ways from points of the patch until something planar is met. What is met further away
/// is the room (a wall's other face is near, the opposite wall far); if only one way meets anything, the scene is
/// there, unless that is nearer than 0.5 m: then it is the other face of a wall or slab, and the room is on the open
/// side. Each point has a vote.
class FreeSide {
 public:
  /// `surface`: per voxel, the number of the surface that it belongs to; VoxelGrid::none: to none.
  FreeSide(const Cloud& cloud, const MortonOrder& order, const VoxelGrid& grid, std::vector<std::uint32_t> surface)
      : cloud_(cloud), order_(order), grid_(grid), surface_(std::move(surface)) {}
  /// `places`: some points of the patch; `own`: the number of its surface.
  void turn(Plane& plane, const std::vector<std::uint32_t>& places, std::uint32_t own) const;

 private:
  double towards_sensors(const Plane& plane, const std::vector<std::uint32_t>& places) const;
  double towards_room(const Plane& plane, const std::vector<std::uint32_t>& places, std::uint32_t own) const;
  double free_length(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, std::uint32_t own) const;

  const Cloud& cloud_;
  const MortonOrder& order_;
  const VoxelGrid& grid_;
  std::vector<std::uint32_t> surface_;
};

}  // namespace atrium::plane
