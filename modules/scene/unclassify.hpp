#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::scene {

/// Takes the classes, storeys and primitives off a mesh: what was made by a method that does not know them is judged by
/// all of it (metric.structure leaves out what is of the class object).
struct Unclassify {
  static constexpr std::string_view type = "scene.unclassify";
  static constexpr std::string_view summary = "Takes the classes, storeys and primitives off a mesh.";

  struct In {
    Input<Mesh> mesh;
  };
  struct Out {
    Mesh mesh;
  };

  static constexpr auto inputs = std::tuple{port<&In::mesh>("Any mesh.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Its vertices, colours and triangles.")};

  static Out run(const In& in);
};

}  // namespace atrium::scene
