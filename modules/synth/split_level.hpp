#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A house on three levels: two rooms above each other, a third one half a storey up, all reached from one
/// stairwell with two flights. Floor areas: stairwell width × depth, lower and upper room 5 m × depth, the room
/// half way up (width + 5 m + inner_wall) × 2.6 m. The stairwell reaches from the lowest floor to the highest
/// ceiling. Its corner is (0, 0, 0).
struct SplitLevel {
  static constexpr std::string_view type = "synth.split_level";
  static constexpr std::string_view summary =
      "Rooms on three levels, half a storey apart, around a stairwell, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 2.4;
    double depth = 4.6;
    double ceiling_height = 2.5;
    double slab = 0.3;
    double inner_wall = 0.15;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The house: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(2.2, 4), "Width of the stairwell."),
      param<&Params::depth>(metres, within(4.4, 8), "Depth of the stairwell and of the rooms beside it."),
      param<&Params::ceiling_height>(metres, within(2.3, 3), "Floor to ceiling of the three rooms."),
      param<&Params::slab>(metres, within(0.1, 0.6), "From the lower room to the upper one."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
