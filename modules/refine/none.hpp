#pragma once
#include "graph/api/node.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/plane_meshes.hpp"
#include "modules/types/structure.hpp"

namespace atrium::refine {

/// Hands the meshes on: the swap that switches vertex translation or mesh clipping off.
struct None {
  static constexpr std::string_view type = "refine.none";
  static constexpr std::string_view summary = "Leaves the meshes as they are.";
  struct In {
    Input<PlaneMeshes> meshes;
    OptionalInput<Adjacency> adjacency;
    OptionalInput<Structure> structure;
  };
  struct Out {
    SharedOutput<PlaneMeshes> meshes;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::meshes>("Meshes."), port<&In::adjacency>("Not used."), port<&In::structure>("Not used.")};
  static constexpr auto outputs = std::tuple{port<&Out::meshes>("The same meshes.")};
  static Out run(const In& in);
};

}  // namespace atrium::refine
