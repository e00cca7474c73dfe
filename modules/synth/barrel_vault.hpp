#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A room under a barrel vault along y, and a room with a flat ceiling at its end. The vault is half a cylinder as
/// strips planes of equal width, their edges on the cylinder: its section has the area strips/2 · r² ·
/// sin(180°/strips) above the springing line, with r half of the width. The corner is (0, 0, 0).
struct BarrelVault {
  static constexpr std::string_view type = "synth.barrel_vault";
  static constexpr std::string_view summary =
      "A room under a barrel vault and a flat room beside it, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 5.0;
    double depth = 8.0;
    double springing = 1.8;
    std::int64_t strips = 20;
    double inner_wall = 0.3;
    double outer_wall = 0.4;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The rooms: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(3, 12), "Width of the vaulted room, twice the radius."),
      param<&Params::depth>(metres, within(4, 30), "Its length."),
      param<&Params::springing>(metres, within(1, 4), "Where the vault begins, above the floor."),
      param<&Params::strips>(count, within(4, 200), "Planes of the vault."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
