#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// One furnished room with a half-round wall: a rectangle, width × depth, and half a disc of radius depth / 2 on its
/// east side, with one floor and one ceiling. A shut door in the west wall, windows in the south and the north wall.
/// The south-west corner of the floor is (0, 0, 0).
///
/// True faces are planar, so the round wall is the least number of equal upright strips with their edges on the circle
/// that leave it nowhere by more than `sagitta`: half a millimetre is far below a scan's noise, and needs 76 strips for
/// a depth of 4.6 m. The scanner sees these strips: they are exactly true.
struct RoundRoom {
  static constexpr std::string_view type = "synth.round_room";
  static constexpr std::string_view summary = "A furnished room with a half-round wall, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 3.6;
    double depth = 4.6;
    double sagitta = 0.0005;
    double ceiling_height = 2.6;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The room: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(2, 50), "Of the rectangle, along x."),
      param<&Params::depth>(metres, within(3, 50), "Along y: the half circle's diameter."),
      param<&Params::sagitta>(metres, within(1e-6, 0.1), "How far the strips may leave the circle."),
      param<&Params::ceiling_height>(metres, within(2.3, 10), "Floor to ceiling."),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
