#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// The 2.5-D way of the floor-plan methods: a plan of rooms, each pulled up from its floor to its ceiling.
///
/// With `plan` (io.read_layout reads what 360-DFPE and others write: JSON of room corners; floorplan.project makes one)
/// its rooms are extruded, or a storey's floors where it has no rooms. A height that the plan does not know is the
/// cloud's if there is one, else `height`.
///
/// With a cloud alone the plan is drawn from it: z up, as the alignment steps give it. Storeys are told apart in the
/// profile of the heights (a slab: what looks down, and at most 1 m above it what looks up); a storey's floor and
/// ceiling are found as percentiles of its points' heights. An image of its plan shows where a ceiling was seen, less
/// the pixels that points cover from above doors and wardrobes (84 % of the height) up to the ceiling (the density
/// image of the field: Okorn et al. 2010; here shares of the height instead of counts, which fall with the distance
/// from the scanner). Each connected piece is a room; what stands free in it, or out into it, thin and short, is none
/// of its border, which is simplified (Douglas and Peucker 1973), turned into the plan's main direction where it nearly
/// runs along it (Manhattan), and moved onto the median of the wall points before it. Its ceiling stands at the median
/// height over it. Sloped ceilings, stairwells (no ceiling, so no room) and openings are beyond this way, as they are
/// beyond its kind.
///
/// A plan without heights takes the cloud's, storey by storey if the cloud shows as many as the plan has; else a
/// warning says so, and the heights of the lowest floor and the highest ceiling stand for all.
///
/// Every room is a closed prism seen from inside: floor, ceiling and one wall per side, with classes, storeys and one
/// primitive each. Errors: neither input; a plan without rooms and floors, with a ring that has less than three corners
/// or is not finite; a cloud of too few points, with floor and ceiling less than a metre apart, or in which no room is
/// found.
struct ExtrudedPlan {
  static constexpr std::string_view type = "baseline.extruded_plan";
  static constexpr std::string_view summary = "Extrudes a floor plan, given or drawn from the cloud, to walls (2.5-D).";
  struct In {
    OptionalInput<FloorPlan> plan;
    OptionalInput<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
    FloorPlan plan;
  };
  struct Params {
    double height = 2.5;
    double percentile = 0.02;
    double pixel = 0.04;
    double closing = 0.3;
    double min_coverage = 0.4;
    double min_room_area = 1;
    double tolerance = 0.1;
    double snap_angle = 20;
    double reach = 0.15;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::plan>("Rooms to extrude; without it they are drawn from the cloud."),
                 port<&In::cloud>("The scan, z up, best with normals: rooms, or only heights if there is a plan.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("The rooms, in the frame of the plan or cloud."),
                                             port<&Out::plan>("What was extruded, with its heights.")};
  static constexpr auto params = std::tuple{
      param<&Params::height>(metres, within(0.1, 100), "Floor to ceiling, where nothing tells it."),
      param<&Params::percentile>(
          ratio, within(0, 0.4),
          "Floor and ceiling are looked for at this and at one minus this share of a storey's points' heights."),
      param<&Params::pixel>(metres, within(0.005, 1), "Of the image: a little more than the points' spacing."),
      param<&Params::closing>(metres, within(0, 1),
                              "Gaps of the ceiling up to twice this are closed, as far as walls let it."),
      param<&Params::min_coverage>(
          ratio, within(0.01, 1),
          "A pixel is a wall's if points cover at least this share of its height above doors and wardrobes."),
      param<&Params::min_room_area>(square_metres, within(0, 1e6),
                                    "Smaller rooms are dropped, smaller holes (columns, cupboards) filled."),
      param<&Params::tolerance>(metres, within(0.001, 10),
                                "Of the simplification: corners that stand out less are given up."),
      param<&Params::snap_angle>(degrees, within(0, 45),
                                 "Walls within this of the main direction take it (Manhattan); 0: each keeps its own."),
      param<&Params::reach>(metres, within(0, 1), "Walls move at most this far onto the points before them."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::baseline
