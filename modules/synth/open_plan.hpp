#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// An office floor without walls: rows of columns, square and round by turns, desks between screens of 1.6 m,
/// windows along all four sides, and one small meeting room in the south-west corner. Columns are solids of 0.4 m
/// square and of 0.5 m diameter (12 sides): the floor is the outline less the columns. The corner is (0, 0, 0).
struct OpenPlan {
  static constexpr std::string_view type = "synth.open_plan";
  static constexpr std::string_view summary =
      "An open office floor with columns, screens and windows all around, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 30.0;
    double depth = 18.0;
    double ceiling_height = 3.2;
    double grid = 6.0;
    double inner_wall = 0.12;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The floor: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(15, 80), "Inner size along x."),
      param<&Params::depth>(metres, within(12, 60), "Inner size along y."),
      param<&Params::ceiling_height>(metres, within(2.6, 5), "Floor to ceiling."),
      param<&Params::grid>(metres, within(4, 12), "Distance of the columns."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
