#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::pcl_nodes {

/// Surface where the distance to the nearest point's tangent plane is zero, by marching cubes
/// (pcl::MarchingCubesHoppe, after Hoppe et al. 1992): swaps with object.poisson.
///
/// Triangles further than `trim` from the points are left out. Each triangle has three vertices of its own (PCL does
/// not join them), with the colours of the nearest points. Normals must point to the side from which the surface was
/// seen; triangles are counter-clockwise from there. Time and memory grow with the number of cells in the box around
/// the cloud. One thread. Fewer than 10 points, or all in one place: an empty mesh. Errors: points without normals;
/// more than 200 million cells.
struct MarchingCubes {
  static constexpr std::string_view type = "pcl.marching_cubes";
  static constexpr std::string_view summary =
      "Surface by marching cubes over tangent planes (pcl::MarchingCubesHoppe).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
  };
  struct Params {
    double cell = 0.03;
    double iso_level = 0;
    double trim = 0.06;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points of the objects, with normals.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Their surface, in the cloud's frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::cell>(metres, within(1e-4, 10), "Edge of a cell, about twice the points' spacing."),
      param<&Params::iso_level>(metres, within(-10, 10), "Distance from the tangent plane at which the surface is."),
      param<&Params::trim>(metres, within(1e-4, 10),
                           "Triangles further than this from the nearest point are dropped.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
