#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Cuts each storey into upright prisms along its walls, and measures what the scan says about each.
///
/// - Lines: the walls of the storey, the largest first. A wall that runs within min_gap of a line is on that line;
///   floors and ceilings join in the same way. Where two ceilings meet, or a ceiling meets the floor, and one of them
///   is slanted, their meeting line is one too, as far as both were seen beside it.
/// - Each line cuts the cells that it passes over its length and `extension` beyond: evidence carries a plane only so
///   far. A cell is cut from side to side, so lines end at others.
/// - Coverage is counted in squares (`pixel`, or larger ones if the scan does not fill these): of a cell the share over
///   which a floor was seen (the lowest one), under which a ceiling was (the highest), and which holds any point
///   between them, but not nearer to a wall's line than three times the noise; of an edge the share on which a wall
///   that looks left, and one that looks right, was seen up to 5 cm below the ceiling that stands before it. What
///   furniture hides is hardest at the ceiling's edge, so cupboards do not count as walls unless they reach it.
/// - A storey without a ceiling gets one where its walls end, one without a floor where they begin: inferred surfaces.
///
/// No random numbers. Errors: a storey of nothing but walls; planes so far apart that their squares would fill the
/// memory. Source: after S. Oesau, F. Lafarge, P. Alliez, Indoor scene reconstruction using feature sensitive primitive
/// extraction and graph-cut, ISPRS J. 90, 2014, with bounded lines and coverage in the place of ray counts.
struct Partition {
  static constexpr std::string_view type = "layout.partition";
  static constexpr std::string_view summary = "Cuts storeys into cells along their walls and measures their coverage.";
  struct In {
    Input<Structure> structure;
  };
  struct Out {
    CellComplex cells;
  };
  struct Params {
    double pixel = 0.05;
    double min_gap = 0.05;
    double extension = 3;
    double margin = 1;
  };
  static constexpr auto inputs = std::tuple{port<&In::structure>("Candidates for walls, floors and ceilings, z up.")};
  static constexpr auto outputs = std::tuple{port<&Out::cells>("The cells of each storey, undecided.")};
  static constexpr auto params = std::tuple{
      param<&Params::pixel>(metres, within(0.01, 1), "Least edge of the squares in which coverage is counted."),
      param<&Params::min_gap>(
          metres, within(0.001, 1),
          "Parallel walls nearer to each other than this share a line: less than the thinnest wall. Three "
          "times the noise where that is more."),
      param<&Params::extension>(metres, within(0, 1000), "How far a wall's line reaches beyond its points."),
      param<&Params::margin>(metres, within(0.1, 100), "Width of the outside around all points.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
