#include "modules/floorplan/write_svg.hpp"

#include "graph/api/write_output.hpp"
#include "modules/floorplan/caption.hpp"

namespace atrium::floorplan {

void WriteSvg::run(const In& in, const Params& params, Context& context) {
  const FloorPlan& plan = *in.plan;
  const DrawnPlan drawn = drawn_plan(plan, params.storey, params.axes);
  if (drawn.storeys.empty()) context.warn("the plan is empty: " + params.path.path + " shows nothing");
  const Sheet sheet = arranged(drawn.storeys, origin_height(plan), params.paper, params.scale, params.units);
  write_output(context, params.path.path,
               svg_sheet(plan, drawn, sheet,
                         {params.title, accuracy_text(in.accuracy ? &*in.accuracy : nullptr), {}, params.dimensions}));
}

}  // namespace atrium::floorplan
