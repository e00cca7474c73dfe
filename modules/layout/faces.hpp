#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Makes the closed surface of each room from its cells: few large polygons, seen from inside.
///
/// Sides between a cell of a room and anything else are walls; sides between two cells of a room are steps where their
/// floors or ceilings differ, else nothing. Pieces of one plane are dissolved into polygons (with holes, around
/// columns), and corners that are none in any of the faces around them are dropped from all of them. So faces meet edge
/// to edge, and each room is a closed surface, 2-manifold unless the room touches itself along an upright edge.
///
/// Floors and ceilings steeper than 60 degrees are walls that lean. A face knows its primitive, if one lies on its
/// plane and looks the same way; without one it is inferred. `observed` is the share of the face's squares that hold
/// points of such primitives, `residual` their RMS distance.
///
/// Where the ceiling comes down to the floor the room ends. What is cut in two that way is two rooms; a room of which
/// nothing is left is left out, with a warning. Rooms are named "room 1" … in their order. A
/// room's area is that of its outline seen from above, without holes; its volume that of the closed surface; its height
/// volume / area, the mean height. A storey's elevation is that of its main floor, its height the mean height of its
/// rooms (by area).
///
/// Errors: cells without any room.
struct Faces {
  static constexpr std::string_view type = "layout.faces";
  static constexpr std::string_view summary = "Makes the closed polygonal surface of each room from its cells.";
  struct In {
    Input<CellComplex> cells;
    Input<Structure> structure;
  };
  struct Out {
    Building building;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::cells>("Cells with room, floor and ceiling."),
                 port<&In::structure>("What the cells were cut from: its points say what was observed.")};
  static constexpr auto outputs = std::tuple{port<&Out::building>("Closed rooms, without openings.")};
  static Out run(const In& in, Context& context);
};

}  // namespace atrium::layout
