#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::pcl_nodes {

/// The closed surface of pcl::Poisson (screened Poisson reconstruction) as it is: swaps with object.poisson, which cuts
/// it back to where points are.
///
/// Normals must point to the side from which the surface was seen; triangles are counter-clockwise from there. Colours
/// are those of the nearest points. One thread, and reconstructions of one program wait for each other. Fewer than 10
/// points, or all in one place: an empty mesh. Error: points without normals.
struct Poisson {
  static constexpr std::string_view type = "pcl.poisson";
  static constexpr std::string_view summary = "Closed surface by Poisson reconstruction (pcl::Poisson).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
  };
  struct Params {
    std::int64_t depth = 8;
    double samples_per_node = 1;
    double point_weight = 4;
    double scale = 1.1;
    bool confidence = false;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points of the objects, with normals.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Their surface, in the cloud's frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::depth>(count, within(3, 12), "Depth of the octree."),
      param<&Params::samples_per_node>(count, within(1, 50), "Least number of points in a cell of the octree."),
      param<&Params::point_weight>(unitless, within(0, 100), "How strongly the surface is drawn to the points."),
      param<&Params::scale>(unitless, within(1, 10), "Of the cube that is solved in, over the cloud's box."),
      param<&Params::confidence>("Whether the lengths of normals say how sure they are (ours are all unit).")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
