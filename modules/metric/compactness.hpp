#pragma once
#include "graph/api/node.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// How light a structural model is, also against the least that its rooms need.
///
/// A closed room with an outline of n corners, upright walls, and flat floor and ceiling has n walls of 2 triangles and
/// n − 2 triangles each in floor and ceiling: 4n − 4. The least for a building is the sum over its rooms; openings need
/// more, and sloped ceilings may, so a perfect model of a real building has a ratio somewhat above 1. Below 1 something
/// is missing. A curved wall, which the truth gives as a chain of fine strips, counts as the coarsest chain of its
/// corners that leaves it nowhere by more than `sagitta`; so do steps of the outline that are smaller than that.
///
/// Metrics: compactness.triangles (degenerate ones too), compactness.polygons: connected coplanar faces (over edges of
/// exactly equal ends, within 0.1° and 1 mm) of one primitive where the mesh has primitives; with a truth
/// compactness.corners (n of all rooms), compactness.least_triangles = Σ(4n − 4) and
/// compactness.ratio = triangles / least_triangles. Triangles of the class
/// object count nowhere. Errors: a vertex that is not finite, a triangle of vertices that do not exist; a truth without
/// rooms, a room's outline of fewer than three corners or with one that is not finite.
struct Compactness {
  static constexpr std::string_view type = "metric.compactness";
  static constexpr int version = 2;
  static constexpr std::string_view summary =
      "Triangles and polygons, and triangles over the least that the rooms need.";
  struct In {
    Input<Mesh> mesh;
    OptionalInput<GroundTruth> truth;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    double sagitta = 0.005;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("The structural model."),
                                            port<&In::truth>("The true rooms; without it: counts only.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("compactness.…: counts and their ratio.")};
  static constexpr auto params = std::tuple{
      param<&Params::sagitta>(
          metres, within(0, 1),
          "How far the least chain of corners may leave a true outline; above 1 mm, what rounding leaves is no "
          "corner."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
