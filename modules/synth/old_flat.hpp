#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A flat of about 1900: six rooms of which no corner is square (walls are off by about skew degrees at most, drawn by
/// the seed), with a bay, two chimney breasts, niches, thick walls of several thicknesses, and ceilings that differ by
/// centimetres. A mirror hangs in the hall. The south-west corner of the plan is near (0, 0, 0).
struct OldFlat {
  static constexpr std::string_view type = "synth.old_flat";
  static constexpr std::string_view summary =
      "An old flat without a right angle: bay, chimney breasts, niches, thick walls, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 13.0;
    double depth = 9.5;
    double ceiling_height = 3.25;
    double skew = 2.0;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The flat: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(11, 20), "Size along x."),
      param<&Params::depth>(metres, within(8.5, 15), "Size along y."),
      param<&Params::ceiling_height>(metres, within(2.6, 4.5), "Floor to ceiling, within 6 cm."),
      param<&Params::skew>(degrees, within(0, 3), "How far walls are off the square, about."),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
