#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Of two proposals of rooms for one scan hands on the one that the scan confirms better.
///
/// Both are made into rooms (layout.faces) and judged (layout.confidence, without openings). What counts is how much of
/// the scan a proposal explains, and how surely: the building's confidence times the observed area of its faces. The
/// other proposal is taken if this is larger by more than `margin`; else, and where neither is a building, the first
/// one is handed on as it is. The rooms of the proposal that is not taken are a second opinion (for layout.confidence),
/// if the scan confirms them nearly as well: where both differ, one is wrong.
///
/// Both must be made from the same planes. No random numbers. Errors: proposals of different planes. Cost: that of
/// layout.faces and layout.confidence, twice.
struct Surest {
  static constexpr std::string_view type = "layout.surest";
  static constexpr std::string_view summary = "Of two proposals of rooms hands on the surer one.";
  struct In {
    Input<CellComplex> cells;
    Input<Structure> structure;
    Input<CellComplex> other_cells;
    Input<Structure> other_structure;
  };
  struct Out {
    SharedOutput<CellComplex> cells;
    SharedOutput<Structure> structure;
    Building rest;
  };
  struct Params {
    double margin = 0.05;
    double comparable = 0.9;
  };
  static constexpr auto inputs = std::tuple{port<&In::cells>("Cells with room, floor and ceiling: the first proposal."),
                                            port<&In::structure>("Its primitives with class and storey."),
                                            port<&In::other_cells>("Those of the other proposal."),
                                            port<&In::other_structure>("Its primitives with class and storey.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::cells>("Those of the proposal that is taken."), port<&Out::structure>("Its primitives."),
                 port<&Out::rest>(
                     "The rooms of the proposal that is not taken, as layout.confidence leaves them; a second opinion. "
                     "None, if they are no building.")};
  static constexpr auto params = std::tuple{
      param<&Params::margin>(ratio, within(0, 10), "By how much the other proposal must be better."),
      param<&Params::comparable>(ratio, within(0, 10),
                                 "The proposal that is not taken is a second opinion if the scan confirms it "
                                 "at least this well, as a share of the one that is.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
