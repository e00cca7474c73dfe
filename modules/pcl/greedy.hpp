#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::pcl_nodes {

/// Triangles over the points themselves by pcl::GreedyProjectionTriangulation: swaps with object.greedy, which leaves
/// out points that stand where others do (PCL's time grows with their square) and has normal_consistency on.
///
/// Each point is a vertex with its own colour. One thread. Fewer than 10 points, or all in one place: an empty mesh.
/// Error: points without normals.
struct Greedy {
  static constexpr std::string_view type = "pcl.greedy";
  static constexpr std::string_view summary =
      "Surface over the points themselves (pcl::GreedyProjectionTriangulation).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
  };
  struct Params {
    double search_radius = 0.1;
    double reach = 2.5;
    std::int64_t max_neighbours = 100;
    double max_surface_angle = 45;
    double min_angle = 10;
    double max_angle = 120;
    bool normal_consistency = false;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points of the objects, with normals.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Their surface, in the cloud's frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::search_radius>(metres, within(1e-4, 10), "Longest possible edge of a triangle."),
      param<&Params::reach>(unitless, within(1, 20), "Of neighbours, over the distance of the nearest (PCL's mu)."),
      param<&Params::max_neighbours>(count, within(3, 1000), "Most neighbours of a point looked at."),
      param<&Params::max_surface_angle>(degrees, within(1, 180), "Points whose normals differ by more are not joined."),
      param<&Params::min_angle>(degrees, within(0, 60), "Least angle aimed at in a triangle."),
      param<&Params::max_angle>(degrees, within(60, 180), "Greatest angle in a triangle."),
      param<&Params::normal_consistency>("Whether the signs of normals count, too.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
