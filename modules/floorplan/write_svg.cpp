#include "modules/floorplan/write_svg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "modules/floorplan/caption.hpp"
#include "modules/floorplan/drawn_storey.hpp"

namespace atrium::floorplan {
namespace {

// The band behind faces whose other side is not known.
constexpr std::string_view hatch =
    "<defs><pattern id=\"hatch\" width=\"0.9\" height=\"0.9\" patternUnits=\"userSpaceOnUse\" "
    "patternTransform=\"rotate(45)\"><path d=\"M0,0V0.9\" stroke=\"#777\" stroke-width=\"0.22\"/></pattern></defs>\n";

std::string note_of(const FloorPlan& plan, double turn) {
  const double degrees = turn * 180 / std::numbers::pi;
  std::string note = "N is +y of the input";
  if (std::abs(degrees) >= 0.05) note += fmt::format(", whose axes are turned by {:.1f}\u00B0", -degrees);
  if (plan.origin.head<2>().norm() >= 1000)
    note += fmt::format("; near x {:.0f} m, y {:.0f} m", plan.origin.x(), plan.origin.y());
  return note;
}

}  // namespace

void WriteSvg::run(const In& in, const Params& params, Context& context) {
  const FloorPlan& plan = *in.plan;
  const double turn = params.axes == Axes::walls ? wall_turn(plan) : 0;
  std::vector<PlanStorey> storeys;
  for (const auto& storey : plan.storeys)
    if (params.storey < 0 || storey.index == params.storey) storeys.push_back(turned(storey, turn));
  if (params.storey >= 0 && storeys.empty())
    throw Error(fmt::format("the plan has no storey {}", params.storey),
                fmt::format("it has {}, counted from 0; -1 draws all", plan.storeys.size()));
  const Sheet sheet = arranged(storeys, origin_height(plan), params.paper, params.scale);
  TitleBlock block{params.title, note_of(plan, turn), 0, storeys.size(), 0, -turn};
  SvgCanvas canvas(sheet.size.x(), sheet.size.y(), params.title);
  canvas.raw(hatch);
  for (std::size_t i = 0; i < storeys.size(); ++i) {
    draw_storey(canvas, sheet, i, storeys[i], params.dimensions);
    block.rooms += storeys[i].rooms.size();
    for (const auto& room : storeys[i].rooms) block.area += room.polygon.area();
  }
  if (storeys.empty()) {
    context.warn("the plan is empty: " + params.path.path + " shows nothing");
    canvas.text(0.5 * sheet.size, 4, "The plan is empty: no walls, floors or ceilings.", "text-anchor=\"middle\"");
  }
  draw_title(canvas, sheet, block);
  const auto path = context.output(params.path.path);
  AtomicFile file(path);
  file.write(std::move(canvas).finish());
  file.commit();
  context.wrote(path);
  return;
}

}  // namespace atrium::floorplan
