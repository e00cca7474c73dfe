#pragma once
#include "modules/floorplan/plan_drawing.hpp"

namespace atrium::floorplan {

/// Draws a floor plan on a sheet of paper, true to scale when it is printed at 100 %.
///
/// Walls of known thickness are filled; a wall of which one face was seen is that face's line with a hatched band where
/// the wall is; a room's edge without a wall is dashed. Doors have their leaves open at a right angle (which way they
/// go is custom, not measured; wide ones are passages), windows double panes, holes in the floor are crossed, those
/// overhead dashed. Each room has its name, area and height; outside of the building stand chains of dimensions, of the
/// wall faces seen from that side and of the whole, in `units`: metres to the centimetre, whole millimetres, or feet
/// and inches to the half inch (12′ 3½″, areas in square feet). The sheet has a scale bar, an arrow along the input's
/// +y (north, if that is a grid's northing), and a title block with the scale, the number of rooms and their area; no
/// date, so that the same plan gives the same bytes. An elevation or a height that is not known is said to be unknown.
/// What was corrected by hand (building.correct) has a small diamond, which the title block explains: walls and
/// openings at their middles, rooms of which a floor or a ceiling was over their names. Dimensions that end at a wall
/// of which nobody has seen a face are in parentheses. With `accuracy` the title block says how far the scan is from
/// the model. A title that is too long for its place is set smaller, or cut off with "…".
///
/// All storeys stand on one sheet, the lowest at the left and at the bottom, at the greatest usual scale that A4 or A3
/// has room for (1:50, 1:100, 1:200, 1:500, …) unless `scale` and `paper` say otherwise; `storey` draws one alone. Many
/// storeys, whose buildings would be smaller than 25 mm there, go on A2, A1 or A0, or on a sheet as large as it takes:
/// a plan that may choose its paper always fits. The plan is turned so that most walls are parallel to the sheet's
/// edges, by at most 45°. For pages that show it, each storey is a group `storey-0`, …, in which the polygons of rooms
/// have their names as `data-room`.
///
/// A plan without storeys gives a sheet that says so, and a warning. Errors: no such storey; a plan that does not fit
/// on the given paper, and which would do; a folder that cannot be written. Then no file is there.
struct WriteSvg {
  static constexpr std::string_view type = "floorplan.write_svg";
  static constexpr std::string_view summary = "Draws a floor plan to scale, with dimensions and labels, as SVG.";
  struct In {
    Input<FloorPlan> plan;
    OptionalInput<Metrics> accuracy;
  };
  using Params = PlanParams<PlanFile::svg>;
  static constexpr auto inputs =
      std::tuple{port<&In::plan>("What to draw."),
                 port<&In::accuracy>("What building.accuracy says: it stands in the title block.")};
  static constexpr auto params = Params::table();
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::floorplan
