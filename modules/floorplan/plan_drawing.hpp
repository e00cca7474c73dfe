#pragma once
#include "graph/api/node.hpp"
#include "modules/floorplan/sheet.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::floorplan {

enum class Axes { walls, input };

enum class PlanFile { svg, pdf };

/// The parameters of the nodes that draw plans, and their table.
template <PlanFile File>
struct PlanParams {
  static constexpr bool svg = File == PlanFile::svg;

  OutputPath path{svg ? "floorplan.svg" : "floorplan.pdf"};
  std::string title = "Floor plan";
  std::int32_t storey = -1;
  Paper paper = Paper::automatic;
  std::int32_t scale = 0;
  Axes axes = Axes::walls;
  bool dimensions = true;
  Units units = Units::metres;

  static constexpr auto table() {
    using P = PlanParams;
    return std::tuple{
        param<&P::path>("The file, in the run's folder."),
        param<&P::title>("What stands in the title block."),
        param<&P::storey>(count, within(-1, 10000), "The storey to draw, 0 the lowest; -1: all of them."),
        param<&P::paper>({{"auto", Paper::automatic},
                          {"A4", Paper::a4},
                          {"A3", Paper::a3},
                          {"A2", Paper::a2},
                          {"A1", Paper::a1},
                          {"A0", Paper::a0}},
                         svg ? "The sheet, upright or lying; auto: A4 or A3, larger if it must be."
                             : "The pages, upright or lying; auto: A4 or A3, larger if it must be."),
        param<&P::scale>(unitless, within(0, 100000), "50 means 1:50; 0: the greatest that fits."),
        param<&P::axes>({{"walls", Axes::walls}, {"input", Axes::input}},
                        svg ? "What is parallel to the sheet: the walls, or the input's x and y."
                            : "What is parallel to the page: the walls, or the input's x and y."),
        param<&P::dimensions>("Draw the chains of dimensions."),
        param<&P::units>(unit_choices, "What lengths are written in; areas are in m², of ft-in in sq ft."),
    };
  }
};

/// "scan to model: median +3.1 mm, 95 % within 12.4 mm (LOA30)" of what building.accuracy says, and the band of USIBD's
/// Level of Accuracy that the 95 % are in; empty where that is not known.
std::string accuracy_text(const Metrics* metrics);

/// The plan's storeys that are drawn, as they lie on paper.
struct DrawnPlan {
  std::vector<PlanStorey> storeys;
  double turn = 0;  ///< by which they are turned, radians
};
/// `storey`: the one to draw; -1: all. Throws Error where the plan has no such storey.
DrawnPlan drawn_plan(const FloorPlan& plan, std::int32_t storey, Axes axes);

/// What stands on a sheet beside its storeys.
struct SheetNotes {
  std::string title;
  std::string accuracy;  ///< accuracy_text(); empty: not known
  std::string remark;    ///< behind the note on the plan's frame
  bool dimensions = true;
};

/// A sheet with these storeys, an SVG file; without storeys it says so.
std::string svg_sheet(const FloorPlan& plan, const DrawnPlan& drawn, const Sheet& sheet, const SheetNotes& notes);

}  // namespace atrium::floorplan
