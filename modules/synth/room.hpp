#pragma once
#include "graph/api/node.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// One furnished room with an L-shaped floor: width × depth less a notch at its far corner (+x, +y). A shut door in the
/// west wall, a window in the south wall. The corner of the L's outer sides is (0, 0, 0).
struct Room {
  static constexpr std::string_view type = "synth.room";
  static constexpr std::string_view summary = "A furnished L-shaped room with exact ground truth.";
  static constexpr bool random = true;
  struct In {};
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
    double furniture = 1.0;
  };
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = std::tuple{port(&Out::scene, "scene", "The room: z up, metres.")};
  static constexpr auto params = std::tuple{
      param(&Params::width, "width", metres, within(3, 50), "Along x."),
      param(&Params::depth, "depth", metres, within(3, 50), "Along y."),
      param(&Params::notch_width, "notch_width", metres, within(0, 48), "Along x; 0: the room is a rectangle."),
      param(&Params::notch_depth, "notch_depth", metres, within(0, 48), "Along y; 0: the room is a rectangle."),
      param(&Params::ceiling_height, "ceiling_height", metres, within(2.3, 10), "Floor to ceiling."),
      param(&Params::outer_wall, "outer_wall", metres, within(0.02, 1), "Depth of the reveals of window and door."),
      param(&Params::furniture, "furniture", unitless, within(0, 3),
            "How densely it is furnished: 0 empty, 1 an ordinary home."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::synth
