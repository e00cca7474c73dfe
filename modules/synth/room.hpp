#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// One furnished room with an L-shaped floor: width × depth less a notch at its far corner (+x, +y). A shut door in the
/// west wall, a window in the south wall; a wardrobe may stand in the corner that the north wall makes with the notch
/// (without one, with the east wall). The corner of the L's outer sides is (0, 0, 0).
struct Room {
  static constexpr std::string_view type = "synth.room";
  static constexpr std::string_view summary = "A furnished L-shaped room with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 6.0;
    double depth = 5.0;
    double notch_width = 2.4;
    double notch_depth = 2.0;
    double ceiling_height = 2.6;
    double outer_wall = 0.3;
    double wardrobe = 0;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The room: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(3, 50), "Along x."),
      param<&Params::depth>(metres, within(3, 50), "Along y."),
      param<&Params::notch_width>(metres, within(0, 48), "Along x; 0: the room is a rectangle."),
      param<&Params::notch_depth>(metres, within(0, 48), "Along y; 0: the room is a rectangle."),
      param<&Params::ceiling_height>(metres, within(2.3, 10), "Floor to ceiling."),
      outer_wall_param<Params>(),
      param<&Params::wardrobe>(
          metres, within(0, 40),
          "Length of a wardrobe, 0.6 m deep and 2.2 m high (or up to the ceiling), along the north wall; 0: none."),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
