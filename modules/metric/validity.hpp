#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Whether a mesh is a valid surface: what a program that wants solids, or a Boolean operation, would trip over. The
/// terms are those of Botsch, Kobbelt, Pauly, Alliez and Lévy, "Polygon Mesh Processing", 2010, chapter 8, and of
/// ISO 19107 (closed, simple, orientable shells).
///
/// Vertices are welded by position first; with `tolerance` 0 only those of exactly equal coordinates. The signs behind
/// every count are exact: degenerate is what has no area at all, and a crossing of 10⁻¹⁶ m is one. So a mesh of which
/// faces should meet along an edge, but were rounded one by one, may cross itself by a rounding error:
/// self_intersections.deep leaves out the crossings of less than `depth`.
///
/// - degenerate_faces: without area after welding. They count nowhere else.
/// - duplicate_faces: those with the same three corners as an earlier one, whatever their winding.
/// - edges.boundary, edges.non_manifold: of one face, of more than two. edges.boundary_length in m.
/// - edges.misoriented: of two faces that run along it in the same direction, so that one of them is inside out.
/// - vertices.non_manifold: whose faces fall apart into several fans if they hang together over edges only (two cubes
///   that touch in a corner). The ends of a non-manifold edge are not counted for it.
/// - self_intersections, of faces that share more than common corners and common edges, in pairs: .crossing: their
///   insides cross; .deep: by more than `depth` (the least reach of either face beyond the other's plane);
///   .overlapping: they lie in exactly one plane and their insides share area, other than duplicates; .touching: all
///   the rest, a corner or an edge of one lies on the other without being one of its own (a T-junction, a wall that
///   stands on the middle of a floor). .faces: how many faces take part in any.
/// - self_intersections.through_edges: edges along which a surface passes through another where no two faces cross: its
///   faces lie on both sides of a face in which it runs, or take turns with the faces of another edge on the same line
///   (a column that is cut into pieces exactly at the faces of the slab that it goes through). These faces are counted
///   as touching; with 0 crossing, overlapping, through_edges and edges.non_manifold no two closed components pass
///   through each other.
/// - components: of faces that hang together over edges; .closed: those without boundary edges; .watertight: those that
///   are closed and without non-manifold edges or vertices, misoriented edges, duplicates and self-intersections,
///   touching ones too (ISO 19107: a shell is simple, it meets itself nowhere);
///   .closed_area: share of the area that closed ones have.
/// - closed, watertight: 1 if all components are (and there is one), else 0.
/// - component_1, component_2, … for the `listed` largest by area: triangles, area in m2, boundary_edges, closed,
///   watertight, and, for closed and consistently oriented ones, volume in m3 (negative where faces look inwards, as a
///   room's do).
///
/// An empty mesh counts 0 everywhere. Errors: a vertex that is not finite or beyond 10⁶⁰ m, a triangle of vertices that
/// do not exist. Time: some seconds for a million triangles.
struct Validity {
  static constexpr std::string_view type = "metric.validity";
  static constexpr std::string_view summary = "Open, non-manifold, degenerate, doubled or crossing faces, exactly.";
  struct In {
    Input<Mesh> mesh;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    double tolerance = 0;
    double depth = 0.001;
    std::int64_t listed = 5;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("What is looked at; classes do not matter.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("validity.…: counts, m, m2, m3.")};
  static constexpr auto params = std::tuple{
      param<&Params::tolerance>(
          metres, within(0, 1),
          "Vertices at most this far apart, step by step, are one. 0: only those at exactly the same place."),
      param<&Params::depth>(metres, within(0, 10), "Shallower crossings are left out of the deep ones."),
      param<&Params::listed>(count, within(0, 1000), "How many components are described one by one."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
