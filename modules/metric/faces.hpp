#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Counts what a mesh is made of (the paper's "number of structural faces" is faces.triangles of the structure).
///
/// Metrics: faces.triangles, faces.vertices (those that triangles use), faces.area; with source primitives also
/// faces.primitives (how many have triangles) and faces.polygons (pieces: triangles of one primitive that hang together
/// over shared edges); with classes the same but vertices under faces.<class>, classes without triangles left out. An
/// empty mesh counts 0. Errors: a triangle of vertices that do not exist, a vertex that is not
/// finite, a column of another length than the triangles.
struct Faces {
  static constexpr std::string_view type = "metric.faces";
  static constexpr std::string_view summary = "Counts triangles, vertices and planar faces, in total and per class.";
  struct In {
    Input<Mesh> mesh;
  };
  struct Out {
    Metrics metrics;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("What is counted.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("faces.…: counts, areas in m2.")};
  static Out run(const In& in);
};

}  // namespace atrium::metric
