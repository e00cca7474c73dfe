#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Moves each plane along its normal to where most of its points lie.
///
/// Least squares put a wall between its own points and those of what stands before it (skirting boards, books, cables:
/// all on one side), so planes of furnished rooms stand some millimetres to centimetres inside. Here the place is an
/// M-estimate of location: the middle of the densest quarter of the signed distances (the shortest interval with half
/// of those in the shortest interval with half of all), then the mean under Tukey's biweight, whose width is 2.5
/// times the spread that this quarter shows. Directions stay. No plane moves further than `reach`.
///
/// Cost: O(n log n) of at most 20,000 points a plane. No random numbers. Source: D. R. Bickel and R.
/// Frühwirth, On a fast, robust estimator of the mode, 2006 (half-sample mode); Tukey's biweight.
struct Settle {
  static constexpr std::string_view type = "plane.settle";
  static constexpr std::string_view summary = "Moves each plane to where most of its points lie.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    double reach = 0.05;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("The same primitives with other offsets.")};
  static constexpr auto params =
      std::tuple{param<&Params::reach>(metres, within(0, 1), "No plane moves further than this.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
