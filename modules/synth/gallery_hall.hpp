#pragma once
#include "graph/api/node.hpp"
#include "modules/synth/shared_params.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A hall of two storeys with a gallery along its east wall, beside it a kitchen below and a bedroom above, whose
/// door gives onto the gallery. The hall is one closed volume: width × depth × (2 · ceiling_height + slab) less the
/// gallery (2 m × depth × slab). A straight flight leads up along the north wall; flight and railing are objects.
/// Its corner is (0, 0, 0).
struct GalleryHall {
  static constexpr std::string_view type = "synth.gallery_hall";
  static constexpr std::string_view summary =
      "A double-height hall with a gallery beside two storeys, with exact ground truth.";
  static constexpr bool random = true;
  struct Out {
    SimulatedScene scene;
  };
  struct Params {
    double width = 7.0;
    double depth = 6.0;
    double ceiling_height = 2.6;
    double slab = 0.3;
    double inner_wall = 0.15;
    double outer_wall = 0.3;
    double furniture = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::scene>("The house: z up, metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::width>(metres, within(6.5, 20), "Width of the hall along x."),
      param<&Params::depth>(metres, within(5, 20), "Depth along y."),
      param<&Params::ceiling_height>(metres, within(2.3, 3), "Floor to ceiling of each storey."),
      param<&Params::slab>(metres, within(0.1, 0.6), "Thickness of the gallery and of the slab between the storeys."),
      inner_wall_param<Params>(),
      outer_wall_param<Params>(),
      furniture_param<Params>(),
  };
  static Out run(const Params& p, Context& context);
};

}  // namespace atrium::synth
