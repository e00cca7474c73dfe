#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// Draws the floor plan of a building of closed rooms, storey by storey.
///
/// - Rooms have the outlines, holes, names and heights (volume over area) that they have in the building. Those whose
///   outline has no area are left out, with a warning.
/// - Walls are the faces of rooms cut at cut_height over their storey's floor; where one ends below that (under a
///   slanted ceiling) it is cut where it is, and what is only above (a lintel) is left out. Two faces that look away
///   from each other at most max_thickness apart are a wall of that thickness where they overlap; a face that has none
///   is a wall of unknown thickness (0), or of the one that was given by hand (building.correct). A wall of whose faces
///   none was seen (on more than a tenth of its area) is inferred, and no part of the walls' bodies. Ends that miss
///   another wall by at most corner_gap are joined to it. Steps within a room are no walls, and openings in them are
///   not drawn.
/// - Doors and windows interrupt the walls, whatever their height; a hole in a slab is drawn in the floor of the storey
///   above and overhead in the one below.
/// - Floors and ceilings: their faces seen from above, without the holes of slabs.
///
/// The plan is in the frame of the pipeline's input, if `transform` (from it to the building's) is wired; turned
/// upright about the plan's origin (a whole metre near the middle) by the least rotation if up is not z there
/// (`to_plan`).
///
/// A building without rooms gives a plan without storeys, and a warning. Errors: min_thickness above max_thickness;
/// faces and rooms of storeys or with corners that are not there; coordinates that are not finite.
struct FromBuilding {
  static constexpr std::string_view type = "floorplan.from_building";
  static constexpr std::string_view summary = "Draws floor plans of a building: rooms, walls, doors, windows.";
  struct In {
    Input<Building> building;
    OptionalInput<Transform> transform;
  };
  struct Out {
    FloorPlan plan;
  };
  struct Params {
    double cut_height = 1.2;
    double min_thickness = 0.02;
    double max_thickness = 0.60;
    double corner_gap = 0.30;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("Closed rooms, with their openings if these are to be drawn."),
                 port<&In::transform>("From the frame that is wanted to that of the building.")};
  static constexpr auto outputs = std::tuple{port<&Out::plan>("One plan per storey.")};
  static constexpr auto params =
      std::tuple{param<&Params::cut_height>(metres, within(0, 100), "Height of the section over the storey's floor."),
                 param<&Params::min_thickness>(metres, within(0.001, 5),
                                               "Least thickness of a wall: nearer faces do not belong together."),
                 param<&Params::max_thickness>(metres, within(0.001, 5),
                                               "Greatest thickness of a wall: what is further apart is drawn as two."),
                 param<&Params::corner_gap>(metres, within(0, 5),
                                            "Ends of walls that miss another wall by at most this are joined to it.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::floorplan
