#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::filter {

/// Thins a cloud to one point per voxel: the centroid of the voxel's points (the paper's noise reduction; it also evens
/// out the density, which falls with the square of the distance from a scanner). Voxels are cubes aligned to multiples
/// of their size from the cloud's local zero (its origin).
///
/// Per voxel: mean of points, colours, intensities; mean of normals, made unit again (the first point's where they
/// cancel out); the most frequent label (the smallest of equals); the source of the point with the lowest index. Voxels
/// come in Morton order, so what is near in space is near in memory. An empty cloud gives an empty cloud, and one
/// that this would leave as it is, as io.read_scan with `voxel` gives, is handed on without a copy.
///
/// The voxels span 2²⁰ sizes along each axis around the scan's middle. Wild points beyond are kept as they are, with a
/// warning; throws Error if more than 100 points and 0.1 % of the cloud are such.
struct VoxelGrid {
  static constexpr std::string_view type = "filter.voxel_grid";
  static constexpr std::string_view summary = "Thins a cloud to the centroids of its voxels.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    SharedOutput<Cloud> cloud;
  };
  struct Params {
    double size = 0.02;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::cloud>("One point per voxel that holds any, same columns, frame and origin.")};
  static constexpr auto params = std::tuple{param<&Params::size>(
      metres, within(0.001, 100),
      "Edge of a voxel. 2 cm keeps what a room's structure needs; above 5 cm, walls 12 cm apart begin to blur.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::filter
