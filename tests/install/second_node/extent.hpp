#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::example {

/// The node that the test adds to the example plugin: this pair of files, and one word in its CMakeLists.txt.
struct Extent {
  static constexpr std::string_view type = "example.extent";
  static constexpr std::string_view summary = "Measures a cloud's extent.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {};
  static constexpr auto inputs = std::tuple{port<&In::cloud>("At least one point.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("extent.x, extent.y, extent.z")};
  static constexpr auto params = std::tuple{};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::example
