#pragma once
#include "graph/api/node.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Finds storeys, and which planes may be their floors, ceilings and walls. An alternative to segment.structure that
/// counts in square metres, not in points, and leaves the choice among candidates to what comes after.
///
/// - Areas are those of the squares (pixel) that hold points of a plane.
/// - A slab is a ceiling and a floor at most max_slab above it, with room to stand (min_clearance) below the one and
///   above the other; or, where no ceiling was scanned, a floor above another one. Slabs divide storeys.
/// - In each storey the largest up-facing plane (area) is the main floor, unless most of the walls go on below it: then
///   it is furniture. Floors are the up-facing planes of at least min_area and min_width up to max_step over it, and
///   those of half of its area with room to stand above.
/// - Ceilings are down-facing planes of at least min_area and min_width, level ones min_clearance or more over the
///   main floor, slanted ones that rise to that height. One that lies, for the most part, less than min_clearance over
///   others is none: the void over suspended ceilings or under a roof.
/// - Walls are all upright planes of at least min_wall_area that are min_wall_length long: the sides of cupboards too.
///   A wall stands in the storey that it overlaps most.
///
/// Errors: no level plane. A storey without a floor or without a ceiling is said in a warning.
struct Storeys {
  static constexpr std::string_view type = "layout.storeys";
  static constexpr std::string_view summary = "Finds storeys and the candidates for floors, ceilings and walls.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    Structure structure;
  };
  struct Params {
    double max_slab = 1.0;
    double min_clearance = 1.8;
    double max_step = 0.35;
    double min_area = 0.5;
    double min_width = 0.5;
    double min_wall_area = 0.25;
    double min_wall_length = 0.25;
    double pixel = 0.05;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives, z up, each plane once.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::structure>("The primitives with class and storey: candidates.")};
  static constexpr auto params =
      std::tuple{param<&Params::max_slab>(metres, within(0, 10), "Greatest thickness of a slab."),
                 param<&Params::min_clearance>(metres, within(0.5, 10), "Room to stand."),
                 param<&Params::max_step>(metres, within(0, 10),
                                          "What lies higher over the main floor is furniture, unless it is large."),
                 param<&Params::min_area>(square_metres, within(0, 1000), "Smallest floor or ceiling."),
                 param<&Params::min_width>(
                     metres, within(0, 100),
                     "A floor or ceiling holds a square this wide; the soffits of doors and windows do not."),
                 param<&Params::min_wall_area>(square_metres, within(0, 1000), "Smallest wall."),
                 param<&Params::min_wall_length>(metres, within(0, 100), "Shortest wall."),
                 param<&Params::pixel>(metres, within(0.01, 1),
                                       "Least edge of the squares; scans that do not fill them have larger ones.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
