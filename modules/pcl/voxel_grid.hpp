#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::pcl_nodes {

/// Thins a cloud to one point per voxel by pcl::VoxelGrid: swaps with filter.voxel_grid. Voxels are the same (cubes at
/// multiples of their size from the cloud's origin), and so are the points but for rounding: PCL sums floats. PCL's
/// numbers of voxels are 32-bit, so blocks of 1024³ voxels are thinned one after another; within a block, points come
/// in PCL's order.
///
/// Means of points, normals (made unit again; +z where they cancel out, with a warning) and colours (cut off, not
/// rounded). PCL has no point type with all of our columns: labels, intensities and sources are dropped, with a
/// warning. One thread. An empty cloud gives an empty cloud. Error: a point more than 2·10⁹ voxels from the cloud's
/// origin.
struct VoxelGrid {
  static constexpr std::string_view type = "pcl.voxel_grid";
  static constexpr std::string_view summary = "Thins a cloud to the centroids of its voxels (pcl::VoxelGrid).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    double size = 0.02;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::cloud>("One point per voxel that holds any, same frame and origin.")};
  static constexpr auto params =
      std::tuple{param<&Params::size>(metres, within(0.001, 100), "Edge of a voxel (PCL's leaf size).")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
