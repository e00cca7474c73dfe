#pragma once
#include <cstdint>
#include <vector>

#include "modules/plane/assignment.hpp"
#include "modules/plane/grow_regions.hpp"
#include "modules/plane/local_spacing.hpp"

namespace atrium::plane {

/// Turns regions of voxels into patches of points: the points of the region's voxels and of their neighbours that are
/// near the plane, split into connected components. Where points fill the space around the plane as they fill the
/// plane, there is none.
struct RegionPatches {
  const MortonOrder& order;
  const VoxelGrid& grid;
  const std::vector<std::int32_t>& owner;
  const LocalSpacing& spacing;
  double cluster_distance;  ///< 0: from the spacing
  GrowthLimits limits;

  /// Signs of the planes are arbitrary.
  std::vector<Patch> patches(const Region& region, const Context& context) const;

 private:
  struct Support {
    std::vector<std::uint32_t> places;
    double share = 0;  ///< of the points in a band three times as wide
  };
  Support support(const Region& region) const;
};

}  // namespace atrium::plane
