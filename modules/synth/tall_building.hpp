#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A building of equal storeys: a corridor of 3 m along x with rooms on both sides, a straight flight of stairs
/// from storey to storey in the corridor. With the defaults 3 storeys of 1 + 16 rooms, 51 in all. All rooms of a
/// side are equally wide: (width − (n − 1) · inner_wall) / n. The corner is (0, 0, 0).
struct TallBuilding {
  static constexpr std::string_view type = "synth.tall_building";
  static constexpr std::string_view summary = "Three storeys of 17 rooms, with stairs and exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    std::int64_t storeys = 3;
    std::int64_t rooms = 8;
    double width = 27.0;
    double room_depth = 4.5;
    double ceiling_height = 2.6;
    double slab = 0.3;
    double inner_wall = 0.12;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The building: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::storeys>(count, within(1, 20), "How many."),
      param<&Params::rooms>(count, within(1, 40), "On each side of the corridor."),
      param<&Params::width>(metres, within(14, 200), "Inner size along x."),
      param<&Params::room_depth>(metres, within(2.5, 12), "Of the rooms along y."),
      param<&Params::ceiling_height>(metres, within(2.4, 3.2), "Floor to ceiling."),
      param<&Params::slab>(metres, within(0.1, 0.8), "From ceiling to the next floor."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::synth
