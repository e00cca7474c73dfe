#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A furnished flat of four rooms: living room, kitchen, bedroom, study; three doors between them, a shut entrance
/// door, a French window and four windows. Its inner walls are two faces each, the wall's thickness apart, and meet in
/// T's that do not line up. Ceilings differ: living room and study have the given height, the kitchen is one step
/// higher, the bedroom one lower. A built-in wardrobe may stand in the bedroom: what it hides stays true. The outer
/// corner of the living room's floor is (0, 0, 0).
struct Flat {
  static constexpr std::string_view type = "synth.flat";
  static constexpr std::string_view summary = "A furnished flat of four rooms with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 10.2;
    double depth = 8.0;
    double ceiling_height = 2.6;
    double ceiling_step = 0.1;
    double inner_wall = 0.12;
    double outer_wall = 0.3;
    double built_in = 0;
    double furniture = 1.0;
    double shelves = 0;
    bool curtains = false;
    bool door_leaves = false;
    bool mirror = false;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The flat: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(7, 30), "Inner size along x, inner walls included."),
      param<&Params::depth>(metres, within(6, 30), "Inner size along y."),
      param<&Params::ceiling_height>(metres, within(2.4, 6), "Floor to ceiling in the living room."),
      param<&Params::ceiling_step>(metres, within(0, 0.15),
                                   "How much higher the kitchen's and lower the bedroom's ceiling is."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      param<&Params::built_in>(
          metres, within(0, 10),
          "Length of a wardrobe, 0.6 m deep and up to the ceiling, along the bedroom's wall to the study; 0: none."),
      furniture_param<Params>(),
      param<&Params::shelves>(
          ratio, within(0, 1),
          "Share of the walls that shelves and cupboards of almost the room's height cover, where they can."),
      param<&Params::curtains>("Whether curtains hang before the windows."),
      param<&Params::door_leaves>("Whether the doors between rooms have leaves, which stand open."),
      param<&Params::mirror>("Whether a large mirror hangs in the bedroom."),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
