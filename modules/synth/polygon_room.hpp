#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// One furnished room whose floor is a regular polygon: six corners make walls at 60°, that no Manhattan frame holds.
/// The first corner lies in +x of the floor's centre, which is (0, 0, 0). A shut door in the first wall and a window in
/// the wall that faces it, or nearly so.
struct PolygonRoom {
  static constexpr std::string_view type = "synth.polygon_room";
  static constexpr std::string_view summary =
      "A furnished room with a regular polygon for its floor, with exact truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    std::int64_t corners = 6;
    double radius = 3.2;
    double ceiling_height = 2.6;
    bool door = true;
    bool window = true;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The room: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::corners>(count, within(3, 24), "How many; each wall must be wide enough for the door."),
      param<&Params::radius>(metres, within(1.5, 40), "Of the circle through the corners."),
      param<&Params::ceiling_height>(metres, within(2.3, 10), "Floor to ceiling."),
      param<&Params::door>("Whether it has a door."),
      param<&Params::window>("Whether it has a window."),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
