#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A round hall and rooms around it, each a sector of the ring between hall and outer wall. Round walls are made of
/// four planes per room; the walls of the rooms towards the hall are parallel to the hall's, inner_wall apart. The
/// middle is (0, 0, 0).
struct SectorRooms {
  static constexpr std::string_view type = "synth.sector_rooms";
  static constexpr std::string_view summary = "Sector-shaped rooms around a round hall, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double radius = 4.0;
    double outer_radius = 8.5;
    double ceiling_height = 2.9;
    std::int64_t rooms = 6;
    double inner_wall = 0.2;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The floor: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::radius>(metres, within(3, 15), "Of the hall, to its corners."),
      param<&Params::outer_radius>(metres, within(6, 30), "Of the outer wall, to its corners."),
      param<&Params::ceiling_height>(metres, within(2.4, 5), "Floor to ceiling."),
      param<&Params::rooms>(count, within(3, 16), "Around the hall."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
