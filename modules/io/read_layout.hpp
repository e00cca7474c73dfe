#pragma once
#include "graph/api/node.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/ground_truth.hpp"

namespace atrium::io {

/// Reads what a building is known to be: rooms, walls, floors, ceilings, openings. JSON, metres, z up; the format is
/// told by its keys.
///
/// - `atrium_truth`: what io.write_truth wrote, bit by bit.
/// - `planes`: rectangles with `label`, `corners` and `normal_out` (away from the room), as headsets measure them.
///   WALL_FACE, FLOOR and CEILING become faces; walls that follow each other end to end within 30 cm become rooms, with
///   the corners where their lines meet. Floors and ceilings are cut to the rooms' outlines where there are rooms (they
///   are bounding rectangles in such files), and kept as they are where there are none. DOOR_FRAME and WINDOW_FRAME
///   become openings, and the faces stay whole: such scans see door leaves and panes. Other labels are furniture and
///   left out.
/// - `rooms`: [{"corners": [[x, y], …] or [[x, y, z], …], "name": "hall", "storey": 0, "floor": 0.0, "height": 2.5}],
/// of
///   which only `corners` is needed; or just a list of corner lists. A room with a height gets a floor, a ceiling and a
///   wall per side; one without has no faces.
///
/// The plan has a storey per storey of the rooms; walls stand in it as the faces that they are, without thickness.
/// Errors, naming the place in the file: no JSON (a mesh for instance), none of these keys, a missing or misshapen
/// value, other units than metres. Warning: walls that close no room.
struct ReadLayout {
  static constexpr std::string_view type = "io.read_layout";
  static constexpr std::string_view summary =
      "Reads known rooms and faces: truth.json, a headset's layout, room corners.";
  struct Out {
    GroundTruth truth;
    FloorPlan plan;
    Mesh mesh;
  };
  struct Params {
    InputPath path;
  };
  static constexpr auto outputs =
      std::tuple{port<&Out::truth>("Faces, rooms and openings."), port<&Out::plan>("The rooms, seen from above."),
                 port<&Out::mesh>("The faces as triangles.")};
  static constexpr auto params = std::tuple{param<&Params::path>("The JSON file.")};
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::io
