#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::align {

/// Leaves the primitives in the frame that they are in: the swap that switches an alignment off (paper, appendix, "Axis
/// Alignment").
struct None {
  static constexpr std::string_view type = "align.none";
  static constexpr std::string_view summary = "Leaves the primitives in the frame that they are in.";
  struct In {
    Input<PlanePrimitives> planes;
    OptionalInput<Transform> transform;
  };
  struct Out {
    SharedOutput<PlanePrimitives> planes;
    Transform transform;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::planes>("Primitives."),
                 port<&In::transform>("What earlier alignments did to them: input frame to their frame.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::planes>("The same primitives."),
                 port<&Out::transform>("The same transform, from the input frame to that of `planes`.")};
  static Out run(const In& in);
};

}  // namespace atrium::align
