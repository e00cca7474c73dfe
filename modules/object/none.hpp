#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::object {

/// No surface for the objects: the swap that leaves them out of the scene.
struct None {
  static constexpr std::string_view type = "object.none";
  static constexpr std::string_view summary = "Leaves the objects out: an empty mesh.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points of the objects; not used.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Nothing, at the cloud's origin.")};
  static Out run(const In& in);
};

}  // namespace atrium::object
