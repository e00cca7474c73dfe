#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::io {

/// Writes planar primitives with their cloud for other programs: a vertex group file, text (.vg) or binary (.bvg).
///
/// .vg is in true coordinates with all digits, planes included: io.read_vg gives the same primitives again. .bvg holds
/// float32, which cannot hold georeferenced coordinates: while the cloud has an origin, that origin is left out, with a
/// warning that says it. Colours and normals of the points are written where there are any; the groups' colours depend
/// on their number only.
///
/// Errors: unknown extension, more than 2³¹-1 points (.bvg), a folder that cannot be written; then no file is there.
struct WriteVg {
  static constexpr std::string_view type = "io.write_vg";
  static constexpr std::string_view summary = "Writes planar primitives to a vertex group file.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Params {
    OutputPath path{"planes.vg"};
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("What to write.")};
  static constexpr auto params =
      std::tuple{param<&Params::path>("The file, in the run's folder: .vg (text) or .bvg (binary, float32).")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::io
