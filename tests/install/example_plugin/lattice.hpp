#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::example {

/// Points of a cubic lattice, as a plugin outside of Atrium's tree would make them.
struct Lattice {
  static constexpr std::string_view type = "example.lattice";
  static constexpr std::string_view summary = "Makes the points of a cubic lattice.";
  struct In {};
  struct Out {
    Cloud cloud;
    std::int64_t points = 0;
  };
  struct Params {
    std::int64_t side = 4;
    double spacing = 0.1;
  };
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs =
      std::tuple{port<&Out::cloud>("The points, the first at zero."), port<&Out::points>("How many there are.")};
  static constexpr auto params =
      std::tuple{param<&Params::side>(count, within(1, 100), "Points along each axis."),
                 param<&Params::spacing>(metres, within(1e-3, 10), "Distance between neighbouring points.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::example
