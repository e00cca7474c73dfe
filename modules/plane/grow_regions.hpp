#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/plane/voxel_grid.hpp"

namespace atrium::plane {

/// Voxels whose points lie near one plane.
struct Region {
  std::vector<std::uint32_t> voxels;
  std::vector<std::uint32_t> border;  ///< neighbours with free points that are not its own; some more than once
  std::size_t spread = 0;             ///< how many of its voxels have been asked for their neighbours
  Moments moments;
  Plane plane;  ///< fitted to the moments, in the columns' frame; sign arbitrary
};

struct GrowthLimits {
  double distance = 0.02;   ///< metres: RMS distance of a voxel's points from the plane that takes it
  double min_cosine = 0.9;  ///< between a planar voxel's normal and the plane's
  std::size_t min_points = 50;
  double min_area = 0;  ///< of a connected patch, square metres
};

/// Grows regions from the flattest voxels over neighbouring voxels, with refits, and merges neighbouring regions that
/// are one plane. By falling number of points.
///
/// `hopeless`: for each voxel the number of free points with which it has led, as a seed, to far too small a region;
/// such a seed is not tried again while it has as many. Zeros at first.
std::vector<Region> grow_regions(const VoxelGrid& grid, const GrowthLimits& limits,
                                 std::vector<std::uint32_t>& hopeless, const Context& context);

}  // namespace atrium::plane
