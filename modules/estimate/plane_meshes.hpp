#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_meshes.hpp"
#include "modules/types/structure.hpp"

namespace atrium::estimate {

/// A planar rectangle for each structural primitive (paper, "Plane Estimation and Integration": M = {M_{P_i}}).
///
/// - A plane whose normal is along a coordinate axis (within `axis_tolerance`) becomes exactly that: its normal is
///   the axis, it goes through the mean of its points, and its rectangle is the bounding one along the other two
///   axes.
/// - Any other plane stays as it was fitted and gets an oriented rectangle. A wall's has two horizontal edges, and so
///   two vertical ones where its plane is vertical; a floor's or ceiling's is the one of least area.
///
/// The rectangle bounds the points' projections onto the plane. `trim` leaves the outermost share of the points out
/// at each of its four sides, against stray inliers. Meshes come in the order of the primitives; corners are
/// counter-clockwise seen from the side that the normal points to. A primitive whose points do not span an area has
/// no mesh, with a warning.
struct PlaneMeshes {
  static constexpr std::string_view type = "estimate.plane_meshes";
  static constexpr std::string_view summary = "A planar rectangle for each wall, floor and ceiling.";
  struct In {
    Input<Structure> structure;
  };
  struct Out {
    atrium::PlaneMeshes meshes;
  };
  struct Params {
    double axis_tolerance = 0.5;
    double trim = 0;
  };
  static constexpr auto inputs = std::tuple{port<&In::structure>("Walls, floors and ceilings; z up.")};
  static constexpr auto outputs = std::tuple{port<&Out::meshes>("One rectangle each, in the same frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::axis_tolerance>(
          degrees, within(0, 10),
          "A normal this near to a coordinate axis is along it (paper: axis-aligned mesh, else oriented "
          "mesh). Turning a "
          "wall of length L about its middle by half a degree moves its ends by less than L/200."),
      param<&Params::trim>(ratio, within(0, 0.2),
                           "Share of the points that may stand out at each side of the rectangle; the paper's bounding "
                           "rectangle is 0.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::estimate
