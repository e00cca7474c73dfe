#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// Decimation by edge collapse at the least quadric error (Garland and Heckbert, "Surface simplification using quadric
/// error metrics", 1997): the paper's comparison method QECD, as VTK has it (vtkQuadricDecimation, after Hoppe 1999,
/// geometry only).
///
/// Borders are kept by constraint planes through them; collapses that would turn a triangle over are not made. VTK
/// checks no more than that: a result may have edges of more than two triangles. The reduction ends early if no edge
/// can be collapsed any more; a warning then says how many triangles are left.
///
/// A vertex has the colour of the nearest one of the source. Classes, storeys and primitives are not kept: triangles
/// come from many. An empty mesh stays empty, one that has few enough triangles stays as it is but for triangles with a
/// repeated corner. Errors: neither triangles nor ratio given; a mesh with vertices that are not finite or corners that
/// do not exist.
struct Quadric {
  static constexpr std::string_view type = "baseline.quadric";
  static constexpr std::string_view summary = "Decimates a mesh by quadric edge collapse (QECD).";
  struct In {
    Input<Mesh> mesh;
  };
  struct Out {
    Mesh mesh;
  };
  struct Params {
    std::int64_t triangles = 0;
    double ratio = 0;
    bool volume_preservation = false;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("What to simplify.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("The simplified mesh, in the same frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::triangles>(count, within(0, 1e9), "At most so many are left. 0: no such target."),
      param<&Params::ratio>(atrium::ratio, within(0, 1),
                            "At most this share of the triangles is left. 0: no such target."),
      param<&Params::volume_preservation>(
          "Whether the volume under each triangle is a part of the error (Lindstrom and Turk 1998)."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::baseline
