#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A hall, in which a closed box of 3 m × 3 m stands (a foreman's office: walls of inner_wall, a level roof at
/// box_height, a door and a room inside), and a wing of one storey beside the hall. The hall is one closed volume:
/// its prism less the box. Its corner is (0, 0, 0).
struct BoxInHall {
  static constexpr std::string_view type = "synth.box_in_hall";
  static constexpr std::string_view summary =
      "A high hall with a room-sized box in it and a low wing beside it, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 10.0;
    double depth = 8.0;
    double ceiling_height = 5.0;
    double box_height = 2.4;
    double inner_wall = 0.1;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The hall: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(8, 40), "Width of the hall along x."),
      param<&Params::depth>(metres, within(7, 40), "Depth along y."),
      param<&Params::ceiling_height>(metres, within(3.5, 12), "Height of the hall."),
      param<&Params::box_height>(metres, within(2.25, 3), "Height of the box, roof included."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
