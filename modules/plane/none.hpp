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
  struct Params {};
  static constexpr auto inputs = std::tuple{port(&In::planes, "planes", "Primitives.")};
  static constexpr auto outputs = std::tuple{port(&Out::planes, "planes", "The same primitives.")};
  static constexpr auto params = std::tuple{};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
