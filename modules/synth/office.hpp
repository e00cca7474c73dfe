#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A furnished office floor of eight rooms: a corridor along x, four offices south of it, a meeting room and two
/// offices north of it. Every room has a door to the corridor, the two south-western offices one between them; the
/// corridor's west end has a shut entrance, its east end a window, the rooms one window per 2.8 m of their outer walls.
/// The walls between offices on either side do not line up; the corridor's ceiling hangs lower; scanners stand twice
/// more along it than in a room. The south-west corner of the first office's floor is (0, 0, 0).
struct Office {
  static constexpr std::string_view type = "synth.office";
  static constexpr std::string_view summary =
      "A furnished office floor, a corridor and seven rooms, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 24;
    double depth = 13;
    double corridor = 2.0;
    double ceiling_height = 2.8;
    double corridor_drop = 0.3;
    double inner_wall = 0.12;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The office: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(18, 80), "Inner size along x, inner walls included."),
      param<&Params::depth>(metres, within(9, 40), "Inner size along y, inner walls included."),
      param<&Params::corridor>(metres, within(1.2, 3), "Width of the corridor."),
      param<&Params::ceiling_height>(metres, within(2.6, 6), "Floor to ceiling in the offices."),
      param<&Params::corridor_drop>(metres, within(0, 0.4), "How much lower the ceiling of the corridor is."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::synth
