#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// Decimation by vertex clustering (Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex
/// scenes", 1993): the paper's comparison method CD.
///
/// Space is cut into cubes of one size, from the least corner of the mesh's bounding box on. All vertices of a cube
/// become one; triangles with two corners in one cube disappear, and so do repeated ones of the same orientation. Where
/// the vertex goes is the difference between programs:
///
/// - mean: the mean of all triangle corners in the cube, as in MeshLab's "Clustering Decimation" (VCG's
///   AverageColorCell), which the field's tables use. No vertex moves further than the cube's diagonal.
/// - quadric: the place of least quadric error (Lindstrom, "Out-of-core simplification of large polygonal models",
///   2000; vtkQuadricClustering), from the singular values above 10⁻³ of the largest, taken back into the cube.
///
/// With a target, the size is searched between `cell_size` and the box's longest side for the finest grid that leaves
/// no more triangles (to a hundredth of the target, or to 10⁻⁴ of the size). The result need not be manifold or closed:
/// what is thinner than a cube collapses, as with every clustering.
///
/// Colours are the mean of the corners'; a triangle keeps its class, storey and primitive. Where all triangles are
/// objects, as in a reconstruction of a whole scan, there are no classes: nobody has told structure from objects. An
/// empty mesh stays empty. Errors: neither cell_size, triangles nor ratio given; a mesh with vertices that are not
/// finite or corners that do not exist.
struct VertexClustering {
  static constexpr std::string_view type = "baseline.vertex_clustering";
  static constexpr std::string_view summary = "Decimates a mesh by vertex clustering (CD).";
  struct In {
    Input<Mesh> mesh;
  };
  struct Out {
    Mesh mesh;
    double cell_size = 0;
  };
  enum class Representative { mean, quadric };
  struct Params {
    double cell_size = 0;
    std::int64_t triangles = 0;
    double ratio = 0;
    Representative representative = Representative::mean;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("What to simplify.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::mesh>("The simplified mesh, in the same frame."),
                 port<&Out::cell_size>("Side of the cubes that was used, metres; 0 for an empty mesh.")};
  static constexpr auto params = std::tuple{
      param<&Params::cell_size>(metres, within(0, 1000),
                                "Side of the cubes, or the least one if there is a target too. 0: the target decides."),
      param<&Params::triangles>(count, within(0, 1e9), "At most so many are left. 0: no such target."),
      param<&Params::ratio>(atrium::ratio, within(0, 1),
                            "At most this share of the triangles is left. 0: no such target."),
      param<&Params::representative>(
          {{"mean", Representative::mean}, {"quadric", Representative::quadric}},
          "Where a cube's vertex stands: at the mean of its corners or at the least quadric error."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::baseline
