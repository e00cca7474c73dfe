#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::layout {

/// Triangulates a building, in the frame of the pipeline's input.
///
/// - shell: the rooms' surfaces, closed, openings filled: triangles between the polygons' own corners, as few as there
///   can be (n − 2, and 2 more for each hole), welded within a room.
/// - structure: the same with doors, windows and slab openings cut out.
/// - openings: what was cut out, one polygon for each side of an opening, of the class object.
///
/// Triangles know class, storey, and as primitive the index of their face in the building.
struct Mesh {
  static constexpr std::string_view type = "layout.mesh";
  static constexpr std::string_view summary = "Triangulates a building: closed rooms, and rooms with openings.";
  struct In {
    Input<Building> building;
    OptionalInput<Transform> transform;
  };
  struct Out {
    atrium::Mesh shell;
    atrium::Mesh structure;
    atrium::Mesh openings;
  };
  struct Params {
    bool class_colours = true;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("Closed rooms with or without openings."),
                 port<&In::transform>("From the frame that is wanted to that of the building.")};
  static constexpr auto outputs = std::tuple{port<&Out::shell>("The rooms, closed."),
                                             port<&Out::structure>("The rooms without what their openings take away."),
                                             port<&Out::openings>("The openings' panes.")};
  static constexpr auto params =
      std::tuple{param<&Params::class_colours>("Colour the vertices by class, for viewers.")};
  static Out run(const In& in, const Params& params);
};

}  // namespace atrium::layout
