#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"

namespace atrium::building {

/// Writes schedules of a building as CSV (RFC 4180: comma, UTF-8, a first line with the columns' names): rooms.csv,
/// doors.csv, windows.csv and walls.csv. Metres, square metres, cubic metres, to a thousandth; an empty field is not
/// known. Walls are those of building.write_ifc, and have the same names there ("wall 3"), as have doors and windows.
///
/// - rooms.csv: number (of building.json, from 0), name, storey, area_m2 (of the plan), perimeter_m (of the plan, with
///   columns), height_m (volume / area), volume_m3, floor_m2 and ceiling_m2 (of the faces, so of slopes their true
///   area), walls_gross_m2 and walls_net_m2 (faces of walls with and without openings), doors, windows, passages,
///   confidence (0 to 1), doubts.
/// - doors.csv: name, kind (door or passage), storey, from_room, to_room ("" outside, or not known), width_m, height_m,
///   sill_m (over the foot of its wall), area_m2, wall_thickness_m (empty: one face of it is known and none was
///   given by hand), wall, corrected (yes: by hand).
/// - windows.csv: the same columns without kind; in a slope height_m is measured along it.
/// - walls.csv: name, storey, left_room, right_room, length_m, thickness_m, thickness_assumed (yes: one face is known
///   and no thickness was given by hand), height_m (greatest), gross_m2 and net_m2 (of one side, with and without
///   openings), gross_m3, net_m3, doors_and_windows, coverage (share of its faces' area that points cover), inferred
///   (yes: none of its faces was seen), faces (their numbers in building.json and accuracy.csv, with blanks between
///   them: "12 31"), corrected (yes: one of them was, by hand).
///
/// A building without rooms gives files of one line, and a warning. Errors: numbers that are not finite, indices of
/// what is not there, a folder that cannot be written. Each file appears whole or not at all.
struct Schedule {
  static constexpr std::string_view type = "building.schedule";
  static constexpr std::string_view summary = "Writes schedules of rooms, doors, windows and walls as CSV.";
  struct In {
    Input<Building> building;
    OptionalInput<Transform> transform;
  };
  struct Params {
    OutputPath rooms{"rooms.csv"};
    OutputPath doors{"doors.csv"};
    OutputPath windows{"windows.csv"};
    OutputPath walls{"walls.csv"};
    double assumed_thickness = 0.20;
    double max_thickness = 0.60;
    double max_column_width = 1.0;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("What is listed."),
                 port<&In::transform>("From the frame that is wanted to that of the building.")};
  static constexpr auto params = std::tuple{
      param<&Params::rooms>("The file of rooms, in the run's folder."),
      param<&Params::doors>("The file of doors and passages."),
      param<&Params::windows>("The file of windows."),
      param<&Params::walls>("The file of walls."),
      param<&Params::assumed_thickness>(metres, within(0.01, 2), "Thickness of walls of which one face only is known."),
      param<&Params::max_thickness>(metres, within(0.01, 5), "Greatest thickness of a wall between two faces."),
      param<&Params::max_column_width>(metres, within(0, 10),
                                       "Holes in a room's plan that are no wider, both ways, are columns.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::building
