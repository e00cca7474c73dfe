#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::align {

/// Turns the scene so that its floors and ceilings are horizontal (paper, Algorithm 1, "Alignment Along Z-axis").
///
/// Among the planes that are roughly horizontal already (|c| at least min_vertical), those whose points' mean normal
/// looks up (U: floors, table tops) and those that look down (D: ceilings) are counted. The plane with most points of
/// the larger list gives the vertical: its normal is turned onto +z (U) or −z (D) by the least rotation. Both branches
/// of the printed algorithm are the same; this is what they must mean. Equal lists count as D, as printed.
///
/// Rotates about the frame's zero; coordinates near zero stay there, since a value's origin moves and its local
/// coordinates only turn. Errors: no plane qualifies (`up` is not roughly up); an `up` without direction.
struct ZAxis {
  static constexpr std::string_view type = "align.z_axis";
  static constexpr std::string_view summary = "Turns the scene until its largest floor or ceiling is horizontal.";
  struct In {
    Input<PlanePrimitives> planes;
    OptionalInput<Transform> transform;
  };
  struct Out {
    PlanePrimitives planes;
    Transform transform;
  };
  struct Params {
    double min_vertical = 0.6;
    std::vector<double> up{0, 0, 1};
  };
  static constexpr auto inputs =
      std::tuple{port<&In::planes>("Primitives; `up` is roughly up."),
                 port<&In::transform>("What earlier alignments did to them: input frame to their frame.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("The primitives and their cloud, z up."),
                                             port<&Out::transform>("From the input frame to that of `planes`.")};
  static constexpr auto params = std::tuple{
      param<&Params::min_vertical>(
          unitless, within(0.0, 1.0),
          "Least |c|, the vertical component of a plane's unit normal, for it to count as roughly horizontal (paper, "
          "Algorithm 1: |c| ≥ 0.6, a tilt of 53 degrees at most)."),
      param<&Params::up>(
          unitless, unbounded,
          "What points roughly upwards in the input's frame, of any length above 0: [0, 0, 1] is the paper's; a depth "
          "camera's is [0, -1, 0], that of many phone apps [0, 1, 0]. c is the component along it.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::align
