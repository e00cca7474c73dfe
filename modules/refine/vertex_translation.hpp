#pragma once
#include "graph/api/node.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/plane_meshes.hpp"

namespace atrium::refine {

/// Which vertices of a wall move onto the line where it meets a neighbour.
enum class Moves { edge, vertices, nearest };

/// Closes the gaps between neighbouring walls (paper, Algorithm 2, "Vertex Translation").
///
/// For each wall i and each of its neighbours j that is a wall, in ascending order: the line where both planes meet has
/// the direction n_i × n_j. The two vertices of wall i that are nearest to it move onto it (orthogonally, V → Q), both
/// or neither, if neither moves further than th_sep. `moves` has the printed ways: vertices tests each of the two on
/// its own (figure 4), nearest moves the nearest one alone (Algorithm 2). Where both walls are upright, edge and
/// vertices give the same. Moved vertices stay in wall i's plane, so the mesh stays planar. Only planes of neighbours
/// are used, never their moved vertices: the order of walls does not matter, that of a wall's neighbours does, as
/// printed.
///
/// How the printed algorithm is read: the test for parallel walls is on the length of the cross product, not on its
/// signed components; the point X of the line is the one nearest to the origin, since the printed system (with Z = 0)
/// is singular for horizontal lines. Against collapse: the vertices of an edge must be neighbours on the rim, and a
/// move after which the mesh would not be convex with the same winding, or have no area left, is not made. Floors and
/// ceilings pass unchanged.
struct VertexTranslation {
  static constexpr std::string_view type = "refine.vertex_translation";
  static constexpr std::string_view summary =
      "Moves each wall's nearest edge onto its meeting line with every neighbour.";
  struct In {
    Input<PlaneMeshes> meshes;
    Input<Adjacency> adjacency;
  };
  struct Out {
    PlaneMeshes meshes;
    std::int64_t moved = 0;
  };
  struct Params {
    double max_separation = 0.5;
    double parallel_tolerance = 0.001;
    Moves moves = Moves::edge;
  };
  static constexpr auto inputs = std::tuple{port<&In::meshes>("Walls, floors and ceilings."),
                                            port<&In::adjacency>("Their neighbourhood: vertex i is mesh i.")};
  static constexpr auto outputs = std::tuple{port<&Out::meshes>("The same meshes in the same order, walls closed."),
                                             port<&Out::moved>("How many vertices are not where they were.")};
  static constexpr auto params = std::tuple{
      param<&Params::max_separation>(metres, within(0, 10),
                                     "No vertex moves further than this (the paper's th_sep in Algorithm 2)."),
      param<&Params::parallel_tolerance>(
          unitless, within(0, 1),
          "Walls with |n_i × n_j| below this are parallel and do not meet (the paper's th_parallel); the "
          "sine of the angle "
          "between them."),
      param<&Params::moves>(
          {{"edge", Moves::edge}, {"vertices", Moves::vertices}, {"nearest", Moves::nearest}},
          "The two vertices nearest to the meeting line: both or neither, each on its own (the paper's figure "
          "4), or the nearest one alone (its Algorithm 2).")};
  static Out run(const In& in, const Params& params);
};

}  // namespace atrium::refine
