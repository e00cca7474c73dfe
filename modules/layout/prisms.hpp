#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Finds rooms as one minimum cut over stacked prisms. An alternative to layout.storeys, layout.partition, layout.rooms
/// and layout.heights that cuts no storeys first: split levels, halls, galleries and leaning walls are rooms like any
/// other.
///
/// - Surfaces: every plane that is not upright and is no furniture may be a floor or a ceiling anywhere near it
///   (level ones up to `reach` further than they were seen, slanted ones a metre, steep ones nowhere). A wall that
///   leans by 3 degrees or more, and 12 cm in all, is a steep one.
/// - Cells: the plan is cut along the walls and where slanted surfaces cross, once for all storeys.
/// - Prisms: the surfaces over a cell, by height, and what lies between each and the next.
/// - Each prism is inside or outside, by one minimum cut. All terms are in square metres: what was seen through it,
/// from
///   a ceiling down to the floor or to furniture; which surfaces and walls look at it from which side; and its borders,
///   which cost less where a surface was seen on them.
/// - Fronts of cupboards are no walls: a ceiling goes on right behind them, over their ends (CeilingsBehind).
/// - Rooms hang together through borders that no wall covers; slabs and the holes of stairs part storeys, which are
///   names for floors of similar height.
///
/// A room needs a scanned ceiling here: where none was scanned there is none, said in the log; layout.storeys infers
/// ceilings, and layout.surest takes the better of both. No random numbers. Errors: no level plane, and planes too far
/// apart. Source: after S. Oesau, F. Lafarge, P. Alliez, Indoor scene reconstruction using feature sensitive primitive
/// extraction and graph-cut, ISPRS J. 90, 2014; C. Mura, O. Mattausch, R. Pajarola, Piecewise-planar reconstruction of
/// multi-room interiors with arbitrary wall arrangements, CGF 35(7), 2016. Cost: linear in the points of level planes;
/// the cut takes milliseconds per thousand cells.
struct Prisms {
  static constexpr std::string_view type = "layout.prisms";
  static constexpr std::string_view summary = "Finds rooms of any height by a minimum cut over stacked prisms.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    CellComplex cells;
    Structure structure;
  };
  struct Params {
    double ceiling_weight = 2;
    double floor_weight = 0.5;
    double outside_weight = 0.3;
    double wall_weight = 1;
    double smoothness = 0.5;
    double complexity = 0.02;
    double min_area = 0.8;
    double min_cover = 0.25;
    double min_clearance = 1.8;
    double min_level_area = 0.5;
    double min_level_width = 0.8;
    double min_wall_area = 0.25;
    double min_wall_length = 0.25;
    double pixel = 0.05;
    double min_gap = 0.05;
    double extension = 3;
    double reach = 3;
    double margin = 1;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives, z up, each plane once.")};
  static constexpr auto outputs = std::tuple{port<&Out::cells>("Cells with room, floor and ceiling, storey by storey."),
                                             port<&Out::structure>("The primitives with class and storey.")};
  static constexpr auto params = std::tuple{
      param<&Params::ceiling_weight>(unitless, within(0, 100), "Of what was seen through a prism."),
      param<&Params::floor_weight>(unitless, within(0, 100), "Of a floor under a prism."),
      param<&Params::outside_weight>(unitless, within(0, 100), "Of what nothing was seen through."),
      param<&Params::wall_weight>(unitless, within(0, 100), "Of a surface before or behind a prism."),
      param<&Params::smoothness>(unitless, within(0, 100), "Of borders where no surface was seen."),
      param<&Params::complexity>(unitless, within(0, 100), "Of all borders."),
      param<&Params::min_area>(square_metres, within(0, 1e6), "Smallest room."),
      param<&Params::min_cover>(ratio, within(0, 1), "Least share of a room's area that was seen."),
      param<&Params::min_clearance>(metres, within(0.5, 10), "Room to stand."),
      param<&Params::min_level_area>(square_metres, within(0, 1000), "Smallest floor or ceiling."),
      param<&Params::min_level_width>(
          metres, within(0, 100),
          "A floor or ceiling holds a square this wide; the soffits of doors and windows do not."),
      param<&Params::min_wall_area>(square_metres, within(0, 1000), "Smallest wall."),
      param<&Params::min_wall_length>(metres, within(0, 100), "Shortest wall."),
      param<&Params::pixel>(
          metres, within(0.01, 1),
          "Least edge of the squares in which coverage is counted; scans that do not fill them have larger ones."),
      param<&Params::min_gap>(
          metres, within(0.001, 1),
          "Surfaces nearer to each other than this are one. Three times the noise where that is more."),
      param<&Params::extension>(metres, within(0, 1000), "How far a wall's line reaches beyond its points."),
      param<&Params::reach>(metres, within(0, 100),
                            "How far from where it was seen a floor or ceiling may go on unseen."),
      param<&Params::margin>(metres, within(0.1, 100), "Width of the outside around all points.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
