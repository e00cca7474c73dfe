#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A furnished house of two storeys. Below: hall, living room, kitchen; above: landing, bedroom, study, their inner
/// walls not above those below. A straight staircase along the hall's west wall leads through an opening in the slab;
/// stairs and railing are objects, the sides of the opening a reveal. The hall's outer corner is (0, 0, 0).
struct TwoStoreys {
  static constexpr std::string_view type = "synth.two_storeys";
  static constexpr std::string_view summary =
      "A furnished house of two storeys with a staircase, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 9.5;
    double depth = 7.5;
    double ceiling_height = 2.55;
    double slab = 0.25;
    double inner_wall = 0.12;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The house: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(7.5, 30), "Inner size along x, inner walls included."),
      param<&Params::depth>(metres, within(7, 30), "Inner size along y."),
      param<&Params::ceiling_height>(metres, within(2.3, 3), "Floor to ceiling of both storeys."),
      param<&Params::slab>(metres, within(0.05, 0.6), "From the lower ceiling to the upper floor."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
