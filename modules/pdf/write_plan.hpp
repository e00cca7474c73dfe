#pragma once
#include "graph/api/node.hpp"
#include "modules/floorplan/plan_drawing.hpp"

namespace atrium::pdf {

/// Draws a floor plan as PDF, true to scale when it is printed at 100 %: the sheets of floorplan.write_svg, one page
/// per storey, the lowest first.
///
/// A plan of one storey is the same sheet at the same scale as its SVG. Of several storeys each has a page of its own,
/// all of the same scale and paper: the greatest usual scale at which each of them fits on A4 or A3, unless `scale` and
/// `paper` say otherwise. All is drawn as lines and areas (librsvg on cairo), to 1.4 µm of paper. Texts are texts that
/// can be searched; what they need of the fonts is in the file.
///
/// Fonts are those that are installed: Helvetica or Arial, else Liberation Sans or DejaVu Sans, and others for
/// characters that these do not have. Where a name has characters that no font has, boxes stand for them, with a
/// warning; Debian's fonts-noto-core and fonts-noto-cjk have most scripts. No time is written, so that the same plan
/// gives the same bytes on a machine with the same fonts.
///
/// A plan without storeys gives a page that says so, and a warning. Errors: no font at all; no such storey; a plan that
/// does not fit on the given paper, and which would do; a folder that cannot be written. Then no file is there.
struct WritePlan {
  static constexpr std::string_view type = "pdf.write_plan";
  static constexpr std::string_view summary = "Draws a floor plan to scale as PDF, a page per storey.";
  struct In {
    Input<FloorPlan> plan;
  };
  struct Params {
    OutputPath path{"floorplan.pdf"};
    std::string title = "Floor plan";
    std::int32_t storey = -1;
    floorplan::Paper paper = floorplan::Paper::automatic;
    std::int32_t scale = 0;
    floorplan::Axes axes = floorplan::Axes::walls;
    bool dimensions = true;
    floorplan::Units units = floorplan::Units::metres;
  };
  static constexpr auto inputs = std::tuple{port<&In::plan>("What to draw.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder."),
      param<&Params::title>("What stands in the title block."),
      param<&Params::storey>(count, within(-1, 10000), "The storey to draw, 0 the lowest; -1: all of them."),
      param<&Params::paper>({{"auto", floorplan::Paper::automatic},
                             {"A4", floorplan::Paper::a4},
                             {"A3", floorplan::Paper::a3},
                             {"A2", floorplan::Paper::a2},
                             {"A1", floorplan::Paper::a1},
                             {"A0", floorplan::Paper::a0}},
                            "The pages, upright or lying; auto: A4 or A3, larger if it must be."),
      param<&Params::scale>(unitless, within(0, 100000), "50 means 1:50; 0: the greatest that fits."),
      param<&Params::axes>({{"walls", floorplan::Axes::walls}, {"input", floorplan::Axes::input}},
                           "What is parallel to the page: the walls, or the input's x and y."),
      param<&Params::dimensions>("Draw the chains of dimensions."),
      param<&Params::units>(floorplan::unit_choices,
                            "What lengths are written in; areas are in m², of ft-in in sq ft."),
  };
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pdf
