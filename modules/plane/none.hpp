#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Hands the primitives on as they are: the swap that leaves out a step between finding planes and using them.
struct None {
  static constexpr std::string_view type = "plane.none";
  static constexpr std::string_view summary = "Leaves the primitives as they are.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    SharedOutput<PlanePrimitives> planes;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("The same primitives.")};
  static Out run(const In& in);
};

}  // namespace atrium::plane
