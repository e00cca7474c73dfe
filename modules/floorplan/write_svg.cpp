#include "modules/floorplan/write_svg.hpp"

#include "modules/floorplan/caption.hpp"

namespace atrium::floorplan {

void WriteSvg::run(const In& in, const Params& params, Context& context) {
  const FloorPlan& plan = *in.plan;
  const PlanDrawing drawing{params.title, params.storey,     params.paper, params.scale,
                            params.axes,  params.dimensions, params.units};
  const DrawnPlan drawn = drawn_plan(plan, drawing);
  if (drawn.storeys.empty()) context.warn("the plan is empty: " + params.path.path + " shows nothing");
  const Sheet sheet = arranged(drawn.storeys, origin_height(plan), params.paper, params.scale, params.units);
  const auto path = context.output(params.path.path);
  AtomicFile file(path);
  file.write(svg_sheet(plan, drawn, sheet, drawing));
  file.commit();
  context.wrote(path);
}

}  // namespace atrium::floorplan
