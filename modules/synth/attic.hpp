#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A furnished attic of two rooms under a gable roof whose ridge runs along x: knee walls, slanted ceilings, a flat
/// ceiling between them where the collar beams would be (none if collar_height is above the ridge), a roof window per
/// room, windows in the gables, and on the north side of the west room a flat-roofed dormer whose front continues the
/// knee wall. Slopes count as ceilings, the dormer's cheeks as walls. The south-west corner of the floor is (0, 0, 0).
struct Attic {
  static constexpr std::string_view type = "synth.attic";
  static constexpr std::string_view summary = "A furnished attic with slanted ceilings, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 9.0;
    double depth = 7.0;
    double knee_height = 1.1;
    double slope = 40;
    double collar_height = 2.6;
    double inner_wall = 0.12;
    double roof = 0.3;
    bool dormer = true;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The attic: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(7, 30), "Inner size along the ridge (x), inner wall included."),
      param<&Params::depth>(metres, within(5, 20), "Inner size across (y)."),
      param<&Params::knee_height>(metres, within(0.3, 1.8), "Height of the walls below the slopes."),
      param<&Params::slope>(degrees, within(25, 60), "Of the roof against the horizontal."),
      param<&Params::collar_height>(metres, within(2.3, 20), "Floor to the flat part of the ceiling."),
      inner_wall_param<Params>(),
      param<&Params::roof>(metres, within(0.02, 1), "Depth of the windows' reveals."),
      param<&Params::dormer>("Whether the west room has a dormer."),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
