#pragma once
#include "graph/api/node.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/plane_meshes.hpp"
#include "modules/types/structure.hpp"

namespace atrium::refine {

/// Cuts floors and ceilings to the room between the walls (paper, Algorithm 3, "Mesh Clipping").
///
/// For each floor or ceiling: the infinite plane of each neighbouring wall, in ascending order, cuts every piece in
/// two; a part stays if more than th_clip of the primitive's points lie in it. As printed, that holds for a piece that
/// a wall's plane does not cross too: it stays whole if it has more than th_clip points. A floor or ceiling without a
/// neighbouring wall is not tested and stays as it is. Pieces are not joined again.
///
/// Points count by their projection onto the mesh's plane; those on a cut belong to the side that the wall's normal
/// points to, and those outside the uncut mesh to none. Walls pass unchanged and come first, then the pieces in the
/// order of their meshes. A mesh of which nothing is left gets a warning.
struct MeshClipping {
  static constexpr std::string_view type = "refine.mesh_clipping";
  static constexpr std::string_view summary =
      "Cuts floors and ceilings along the walls and drops the parts without points.";
  struct In {
    Input<PlaneMeshes> meshes;
    Input<Adjacency> adjacency;
    Input<Structure> structure;
  };
  struct Out {
    PlaneMeshes meshes;
  };
  struct Params {
    std::int64_t min_points = 50;
  };
  static constexpr auto inputs = std::tuple{port<&In::meshes>("Walls, floors and ceilings."),
                                            port<&In::adjacency>("Their neighbourhood: vertex i is mesh i."),
                                            port<&In::structure>("The primitives, whose points are counted.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::meshes>("Walls, then the pieces of floors and ceilings: convex polygons.")};
  static constexpr auto params = std::tuple{param<&Params::min_points>(
      count, within(0, 1e9),
      "A part stays if more than this many points lie in it (the paper's th_clip, 50; its appendix tries 25 and 100). "
      "It depends on the density of the points.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::refine
