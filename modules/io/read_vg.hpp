#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::io {

/// Reads planar primitives of another program: vertex group files, text (.vg) or binary (.bvg), as written by Mapple,
/// Easy3D and the tools around PolyFit (Nan and Wonka 2017).
///
/// Every plane gets its inliers ascending; the primitives come by falling number of inliers; a group's children are
/// groups of their own. Origin and dropped points: as in io.read_scan. A plane whose parameters are all zero, are no
/// unit normal or do not pass through its points is fitted to the points (least squares), with a warning; then its
/// normal looks where the points' normals, or else the file's parameters, look.
///
/// Warnings, each with a number: groups that are no planes (skipped), empty groups (skipped), groups with too few
/// points to fit (skipped), points in two groups (the first keeps them). Errors, with line or byte: file missing,
/// empty, truncated, a count that the file cannot hold, an index of no point.
struct ReadVg {
  static constexpr std::string_view type = "io.read_vg";
  static constexpr std::string_view summary = "Reads planar primitives from a vertex group file.";
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    InputPath path;
    double scale = 1.0;
  };
  static constexpr auto outputs =
      std::tuple{port<&Out::planes>("The primitives with their cloud, in the file's frame, in metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file: .vg (text) or .bvg (binary)."),
      param<&Params::scale>(unitless, within(1e-9, 1e9),
                            "Factor from the file's unit to metres: 0.001 for millimetres, 0.3048 for feet.")};
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::io
