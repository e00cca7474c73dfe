#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::filter {

/// Hands the cloud on as it is: the swap that leaves a filter out.
struct None {
  static constexpr std::string_view type = "filter.none";
  static constexpr std::string_view summary = "Leaves the cloud as it is.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    SharedOutput<Cloud> cloud;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The same points.")};
  static Out run(const In& in);
};

}  // namespace atrium::filter
