#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::trial {

struct Join {
  static constexpr std::string_view type = "trial.join";
  static constexpr std::string_view summary = "Counts the points of two clouds.";
  struct In {
    Input<Cloud> a, b;
  };
  struct Out {
    double points = 0;
  };
  struct Params {};
  static constexpr auto inputs = std::tuple{port<&In::a>("One cloud."), port<&In::b>("The other one.")};
  static constexpr auto outputs = std::tuple{port<&Out::points>("How many.")};
  static constexpr auto params = std::tuple{};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::trial
