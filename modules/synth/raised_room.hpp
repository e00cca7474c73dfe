#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A living room and beside it a room whose floor lies a few steps higher, with the ceiling at the same height; the
/// door between them has its threshold at the higher floor. Floor areas: width × depth and 4 m × 3.6 m. The corner
/// is (0, 0, 0).
struct RaisedRoom {
  static constexpr std::string_view type = "synth.raised_room";
  static constexpr std::string_view summary = "Two rooms whose floors differ by a few steps, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 7.0;
    double depth = 5.0;
    double ceiling_height = 3.1;
    double rise = 0.5;
    double inner_wall = 0.12;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The rooms: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(5, 20), "Width of the lower room along x."),
      param<&Params::depth>(metres, within(4, 20), "Depth of the lower room along y."),
      param<&Params::ceiling_height>(metres, within(2.6, 5), "Height of both ceilings above the lower floor."),
      param<&Params::rise>(metres, within(0.1, 0.6), "From the lower floor to the higher one."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
