#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::building {

/// Applies corrections by hand to a building: what a person who knows better says in a file (share/doc/corrections.md,
/// share/schema/corrections.schema.json). Without a file the building goes through as it is.
///
///     atrium_corrections: 1
///     corrections:
///       - rename_room: {room: room 1, name: Kitchen}
///       - merge_rooms: {rooms: [room 2, room 3], name: Hall}
///       - split_room: {room: room 4, from: [1.2, 3.0], to: [4.8, 3.0], names: [Bath, Store], thickness: 10 cm}
///       - add_opening: {room: Hall, wall: wall 7, kind: door, distance: 35 cm, width: 90 cm, height: 2.1 m}
///       - change_opening: {opening: window 2, width: 1.2 m, sill: 85 cm}
///       - drop_opening: {opening: door 3}
///       - move_wall: {room: Kitchen, at: [0.0, 2.4], by: 3 cm}
///       - set_thickness: {room: Kitchen, wall: wall 4, thickness: 36 cm}
///       - drop_face: {room: Bath, face: 31}
///       - set_ceiling: {room: Bath, height: 2.4 m}
///       - set_floor: {room: Bath, level: 2 cm}
///
/// What is named: rooms by their names, at that point of the file or in the input; doors and windows as in doors.csv
/// and windows.csv; walls by `wall`, as in walls.csv and building.ifc, by `face`, the number in building.json and
/// accuracy.csv, or by `at`, a place at the wall in the scan's frame and unit ([x, y], or [x, y, z]). Numbers are
/// always those of the building before all corrections, so lines added to the file change no line before them. Lengths
/// are metres, or have a unit.
///
/// Numbers change with the program and its parameters. So each correction may say where the thing is, in the scan's
/// frame and unit: `near: [x, y]` or `[x, y, z]` (merge_rooms: two of them). Beside a name or number it is checked: to
/// within 0.3 m, and nothing of its kind may be more than 5 cm nearer. Instead of `opening`, `room` or `rooms` it means
/// the nearest one within 0.5 m, where it is clear which that is.
///
/// - rename_room: the name must be free.
/// - merge_rooms: the wall between two rooms goes, where both have a face of it (or where they touch), with its doors
///   and windows; what of a face has none behind it stays. Level floors and ceilings that differ by less than 2 cm take
///   the first room's height.
/// - split_room: along a line through two places, which crosses the room's outline exactly twice. `names`: of the part
///   on the line's left from `from` to `to`, and of the other. Without `thickness` the parts touch, with it a wall of
///   that thickness stands on the line.
/// - add_opening: `distance` from the wall's left corner (as seen from the room; `corner: right`: from the right one)
///   to the nearer jamb; `sill` over the wall's foot, which windows must say. Where the face of another room lies
///   behind all of it, the opening goes through to it; a door stands on both floors.
/// - change_opening: `kind`, `width`, `height`, `sill`, and its place by `distance` or by so much to the right (`by`);
///   where it joins two rooms, `room` says from where. Without a place its middle stays.
/// - move_wall: `by` is metres outwards, as seen from the room. The face moves that was measured, and the wall gets
///   thinner or thicker; `both: true` moves the whole wall, with all faces back to back in it, and its thickness stays.
///   Walls beside it get longer or shorter; doors and windows in it go with it.
/// - set_thickness: of a wall where one face of it is known, an outer wall: so thick it is in floor plan, IFC and
///   schedules, wherever no other face is behind that one. A later move_wall without `both` makes it thinner or
///   thicker.
/// - drop_face: two walls beside it that meet are extended until they do. Where they are parallel, the sides of a
///   pilaster or a niche, the wall beyond them takes the face's place. Of a column all faces go.
/// - set_ceiling: `height` over the room's largest floor, or by so much up (`by`); set_floor: `level` over the storey's
///   elevation, or `by`. All of a room's ceilings (floors), or that of number `face`; only a level one has a height.
///
/// Rooms stay closed. Outlines, areas, heights, volumes, walls, openings' sides and storeys are derived anew. A
/// corrected room says so in its doubts ("corrected by hand: wall 3 moved by 0.120 m"), but for its name; the faces and
/// openings that were changed or are new say it in their own `corrections`. A face that moves keeps what was seen of
/// it; new ones are inferred. Confidences stay.
///
/// Errors, with file, line and column, and what would be right: no YAML, unknown or missing keys, wrong values; a room,
/// wall, face or opening that is not there, or not at the place that `near` says; an opening that leaves its wall or
/// overlaps another one; the thickness of a wall whose two faces are known, or one that reaches into another room; a
/// wall moved so far that another has no width left, or into another room; what would not be one closed room. Then
/// nothing is corrected. No random numbers. Cost: seconds for 100 rooms.
struct Correct {
  static constexpr std::string_view type = "building.correct";
  static constexpr std::string_view summary = "Applies corrections by hand, from a file, to a building.";
  struct In {
    Input<Building> building;
    OptionalInput<Transform> transform;
    OptionalInput<Cloud> scan;
  };
  struct Out {
    SharedOutput<Building> building;
  };
  struct Params {
    std::vector<InputPath> paths;
    double max_thickness = 0.60;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("What is corrected."),
                 port<&In::transform>("From the frame in which the file's places are to that of the building."),
                 port<&In::scan>("The scan: the file's places are in its unit; without it in metres.")};
  static constexpr auto outputs = std::tuple{port<&Out::building>("The corrected building.")};
  static constexpr auto params = std::tuple{
      param<&Params::paths>("Files of corrections, applied one after the other; none: nothing changes."),
      param<&Params::max_thickness>(metres, within(0.01, 5), "Greatest thickness of a wall between two faces.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::building
