#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::object {

/// No surface for the objects: the swap that leaves them out of the scene. What only prepares their points does not
/// run.
struct None {
  static constexpr std::string_view type = "object.none";
  static constexpr std::string_view summary = "Leaves the objects out: an empty mesh.";
  struct In {
    UnusedInput<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points of the objects.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Nothing.")};
  static Out run();
};

}  // namespace atrium::object
