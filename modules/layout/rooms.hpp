#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Decides which cells are inside of a room: the labelling of least energy, by one minimum cut per storey.
///
/// All terms are in square metres of surface, so no weight depends on the number of points:
/// - A cell under a ceiling that was seen should be inside, one over a floor as well (ceiling_weight and floor_weight
///   times the covered area); as far as no ceiling was seen over it, it should be outside (outside_weight times that
///   area), whatever was seen of its floor. In a storey whose ceiling was not scanned (it shows less than three tenths
///   of what the floor does), the floor, or what stands on it where that is more, counts for the floor and between
///   walls for the ceiling.
/// - A wall was seen from inside, and no ceiling goes on right behind it, over its end, as one does behind the front of
///   a cupboard (CeilingsBehind): the cell before it should be inside, the one behind it outside (wall_weight times its
///   area, if it reaches the ceiling), the latter less the more of floor or ceiling was seen there.
/// - A border between inside and outside should be a wall that looks inside: its area that is none costs
///   `smoothness`, and all of it `complexity`. Where both faces of a wall run on beside a cell that shows no ceiling,
///   the wall goes on, hidden by what stands before it.
///
/// Rooms are what hangs together, but not through a wall so thin that its two faces share a line, nor through a neck of
/// less than 40 cm (parted_at_necks); the inside of a wall between two rooms is in none (clear_wall_bodies). A room of
/// less than
/// min_area is outside, and one with less than min_cover of its area seen: of each cell counts what covers most of it,
/// floor, ceiling or points between them. Rooms are numbered by falling area, through all storeys.
///
/// A scan without any room: a warning, all cells outside. Source: data terms after P. Labatut, J.-P. Pons, R. Keriven,
/// Robust and efficient surface reconstruction from range data, CGF 28(8), 2009, and Oesau et al. 2014 (see
/// layout.partition).
struct Rooms {
  static constexpr std::string_view type = "layout.rooms";
  static constexpr std::string_view summary = "Decides which cells are inside of rooms, by a minimum cut.";
  struct In {
    Input<CellComplex> cells;
  };
  struct Out {
    CellComplex cells;
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
    double min_island = 0.4;
    double min_detail = 0.03;
  };
  static constexpr auto inputs = std::tuple{port<&In::cells>("Cells with their coverage.")};
  static constexpr auto outputs = std::tuple{port<&Out::cells>("The same, each with its room or none.")};
  static constexpr auto params = std::tuple{
      param<&Params::ceiling_weight>(unitless, within(0, 100), "Of a ceiling over a cell."),
      param<&Params::floor_weight>(unitless, within(0, 100), "Of a floor under a cell."),
      param<&Params::outside_weight>(unitless, within(0, 100), "Of what shows no ceiling."),
      param<&Params::wall_weight>(unitless, within(0, 100), "Of a wall before or behind a cell."),
      param<&Params::smoothness>(unitless, within(0, 100), "Of borders where no wall was seen."),
      param<&Params::complexity>(unitless, within(0, 100), "Of all borders."),
      param<&Params::min_area>(square_metres, within(0, 1e6), "Smallest room."),
      param<&Params::min_island>(
          ratio, within(0, 1),
          "What a room surrounds belongs to it, unless this share of the walls around it was seen: a column."),
      param<&Params::min_detail>(square_metres, within(0, 1),
                                 "Smallest niche or pilaster, seen from above; what is smaller is evened out."),
      param<&Params::min_cover>(
          ratio, within(0, 1),
          "Least share of a room's area seen as floor, ceiling or anything between, whichever covers most of a cell.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
