#pragma once
#include "graph/api/node.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/plane_meshes.hpp"

namespace atrium::estimate {

/// Which meshes are neighbours (the paper's adjacency graph G = (V, E)): those whose polygons are nearer to each other
/// than th_sep. The distance is the exact one between the polygons, insides included: 0 if they touch or cross.
struct Adjacency {
  static constexpr std::string_view type = "estimate.adjacency";
  static constexpr std::string_view summary = "Joins meshes that are near to each other in a graph.";
  struct In {
    Input<atrium::PlaneMeshes> meshes;
  };
  struct Out {
    atrium::Adjacency adjacency;
  };
  struct Params {
    double max_separation = 0.5;
  };
  static constexpr auto inputs = std::tuple{port<&In::meshes>("Convex planar polygons.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::adjacency>("Vertex i is mesh i; an edge carries the separation in metres.")};
  static constexpr auto params = std::tuple{param<&Params::max_separation>(
      metres, within(0, 10),
      "Meshes less than this apart are neighbours (the paper's th_sep, 0.5 m; its appendix tries 0.1 to 0.5 m).")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::estimate
