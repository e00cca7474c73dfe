#pragma once
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
/// does not fit on the given paper, and which would do; a folder that cannot be written. Then no file is there. A
/// program of its own draws, atrium-pdf-draw beside the plugin: its libraries end a program where memory or threads
/// lack, which then is an error of this node.
struct WritePlan {
  static constexpr std::string_view type = "pdf.write_plan";
  static constexpr std::string_view summary = "Draws a floor plan to scale as PDF, a page per storey.";
  struct In {
    Input<FloorPlan> plan;
    OptionalInput<Metrics> accuracy;
  };
  using Params = floorplan::PlanParams<floorplan::PlanFile::pdf>;
  static constexpr auto inputs =
      std::tuple{port<&In::plan>("What to draw."),
                 port<&In::accuracy>("What building.accuracy says: it stands in the title block.")};
  static constexpr auto params = Params::table();
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pdf
