#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// Gives each cell of a room one floor and one ceiling: labellings of least energy, by α-expansion within each storey.
///
/// A cell pays for the area that the chosen surface does not cover, more where another one was seen instead. Where two
/// neighbouring cells of a room have different surfaces, there is a step: its area costs `step_weight`, so that what
/// was not seen takes the surface of its neighbours, and a surface ends where it meets the next. Ceilings less than
/// min_clearance over the floor are none, where there is a choice.
///
/// A room of which less than min_seen lies under a scanned ceiling has one of its own where its walls end (a third of
/// their length rises higher), in cells that no scanned one covers for the most part.
///
/// Heights that differ by less than three times the noise are one. Last, parts of a floor or ceiling that hardly show
/// their surface take the one beside them (min_patch).
///
/// Source: Y. Boykov, O. Veksler, R. Zabih, Fast approximate energy minimization via graph cuts, PAMI 23(11), 2001.
struct Heights {
  static constexpr std::string_view type = "layout.heights";
  static constexpr std::string_view summary = "Gives each cell of a room its floor and its ceiling, by α-expansion.";
  struct In {
    Input<CellComplex> cells;
  };
  struct Out {
    CellComplex cells;
  };
  struct Params {
    double step_weight = 0.5;
    double border_weight = 0.02;
    double min_clearance = 0.5;
    double min_seen = 0.3;
    double min_patch = 2;
  };
  static constexpr auto inputs = std::tuple{port<&In::cells>("Cells with their rooms.")};
  static constexpr auto outputs = std::tuple{port<&Out::cells>("The same, each with its floor and ceiling.")};
  static constexpr auto params = std::tuple{
      param<&Params::step_weight>(unitless, within(0, 100), "Of a step's area against a cell's."),
      param<&Params::border_weight>(metres, within(0, 10),
                                    "Of a border between two surfaces: the height of a step that costs as much."),
      param<&Params::min_clearance>(metres, within(0, 10), "Least height of a room."),
      param<&Params::min_seen>(ratio, within(0, 1),
                               "Share of a room's ceiling that must have been scanned; without, one is inferred."),
      param<&Params::min_patch>(
          square_metres, within(0, 1e6),
          "Part of a floor or ceiling that must show half of its surface to be one of its own; a larger part must "
          "show a quarter, or two fifths beside one that shows twice as much. 0: all stay as the labelling has them.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
