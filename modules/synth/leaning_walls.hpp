#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// Two rooms under one flat ceiling whose outer walls lean: the south walls inwards by lean, the north walls
/// outwards by half of it. The wall between the rooms and the ends are upright. The corner of the floor is (0, 0,
/// 0).
struct LeaningWalls {
  static constexpr std::string_view type = "synth.leaning_walls";
  static constexpr std::string_view summary = "Two rooms with leaning walls, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 9.0;
    double depth = 5.0;
    double ceiling_height = 2.7;
    double lean = 12.0;
    double inner_wall = 0.12;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The rooms: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(6, 20), "Inner size of the floor along x."),
      param<&Params::depth>(metres, within(4, 12), "Inner size of the floor along y."),
      param<&Params::ceiling_height>(metres, within(2.3, 4), "Floor to ceiling."),
      param<&Params::lean>(degrees, within(0, 15), "How far the south walls lean off the vertical."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
