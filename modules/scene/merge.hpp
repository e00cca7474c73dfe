#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/plane_meshes.hpp"

namespace atrium::scene {

enum class Frame { input, aligned };

/// Puts the parts together (paper, "Overview", figure 2 (g) and (h)): structure alone, objects alone, all, and all but
/// the ceilings.
///
/// Polygons are triangulated as fans (they are convex); vertices are shared within a polygon only. Each triangle keeps
/// its class, storey and primitive; those of objects have class object, storey −1 and primitive −1. The meshes are in
/// the frame of the input of the pipeline, moved back by the inverse of `transform`, unless `frame` is aligned. Without
/// `transform` both are the same. Vertices are coloured by class; objects keep colours of their own. With
/// `class_colours` off, that is so only if the objects have colours: a mesh has them for all its vertices or for none.
struct Merge {
  static constexpr std::string_view type = "scene.merge";
  static constexpr std::string_view summary = "Assembles structure and objects, with and without ceilings.";
  struct In {
    Input<PlaneMeshes> meshes;
    OptionalInput<Mesh> objects;
    OptionalInput<Transform> transform;
  };
  struct Out {
    Mesh structure;
    Mesh objects;
    Mesh scene;
    Mesh scene_without_ceiling;
  };
  struct Params {
    Frame frame = Frame::input;
    bool class_colours = true;
  };
  static constexpr auto inputs = std::tuple{port<&In::meshes>("Walls, floors and ceilings: convex polygons."),
                                            port<&In::objects>("What is not structure, in the same frame."),
                                            port<&In::transform>("From the input frame to that of the meshes.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::structure>("Walls, floors and ceilings."), port<&Out::objects>("The objects."),
                 port<&Out::scene>("Structure and objects."),
                 port<&Out::scene_without_ceiling>("The same without ceilings, to look into.")};
  static constexpr auto params = std::tuple{
      param<&Params::frame>({{"input", Frame::input}, {"aligned", Frame::aligned}},
                            "input: where the scan was, to the millimetre; aligned: z up, walls along x and y."),
      param<&Params::class_colours>("Colour the structure's vertices by class, for viewers.")};
  static Out run(const In& in, const Params& params);
};

}  // namespace atrium::scene
