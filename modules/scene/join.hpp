#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::scene {

/// Puts a structure's mesh and that of the objects together: all, and all but the ceilings.
///
/// The structure stays as it is, first in both, in its frame; objects are moved there by the inverse of `transform` and
/// get class object, storey −1 and primitive −1. A mesh has colours for all its vertices or for none: if only one of
/// the two has them, the other gets those of its classes.
///
/// Errors: a structure without the columns `classes`, `storeys` and `primitives`.
struct Join {
  static constexpr std::string_view type = "scene.join";
  static constexpr std::string_view summary = "Joins the meshes of structure and objects, with and without ceilings.";
  struct In {
    Input<Mesh> structure;
    OptionalInput<Mesh> objects;
    OptionalInput<Transform> transform;
  };
  struct Out {
    Mesh objects;
    Mesh scene;
    Mesh scene_without_ceiling;
  };
  static constexpr auto inputs = std::tuple{port<&In::structure>("Walls, floors and ceilings, with classes."),
                                            port<&In::objects>("What is not structure."),
                                            port<&In::transform>("From the structure's frame to that of the objects.")};
  static constexpr auto outputs = std::tuple{
      port<&Out::objects>("The objects, in the structure's frame."), port<&Out::scene>("Structure and objects."),
      port<&Out::scene_without_ceiling>("The same without ceilings, to look into.")};
  static Out run(const In& in);
};

}  // namespace atrium::scene
