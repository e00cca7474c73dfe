#include "modules/floorplan/plan_drawing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "graph/api/error.hpp"
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
  std::string note = "The arrow is +y of the input";
  if (std::abs(degrees) >= 0.05) note += fmt::format(", whose axes are turned by {:.1f}\u00B0", -degrees);
  if (plan.origin.head<2>().norm() >= 1000)
    note += fmt::format("; near x {:.0f} m, y {:.0f} m", plan.origin.x(), plan.origin.y());
  return note;
}

}  // namespace

std::string accuracy_text(const Metrics* metrics) {
  const auto value = [&](std::string_view name) {
    if (metrics != nullptr)
      for (const auto& metric : metrics->values)
        if (metric.name == name) return metric.value;
    return std::numeric_limits<double>::quiet_NaN();
  };
  const double median = value("accuracy.all.median"), p95 = value("accuracy.all.p95");
  if (!std::isfinite(median) || !std::isfinite(p95)) return {};
  int band = 10;
  for (const double limit : {0.05, 0.015, 0.005, 0.001})  // metres: of LOA20 to LOA50, USIBD 2016
    if (p95 <= limit) band += 10;
  return fmt::format("scan to model: median {:+.1f} mm, 95 % within {:.1f} mm (LOA{})", 1000 * median, 1000 * p95,
                     band);
}

DrawnPlan drawn_plan(const FloorPlan& plan, std::int32_t storey, Axes axes) {
  DrawnPlan drawn{{}, axes == Axes::walls ? wall_turn(plan) : 0};
  for (const auto& s : plan.storeys)
    if (storey < 0 || s.index == storey) drawn.storeys.push_back(turned(s, drawn.turn));
  if (storey >= 0 && drawn.storeys.empty())
    throw Error(fmt::format("the plan has no storey {}", storey),
                fmt::format("it has {}, counted from 0; -1 draws all", plan.storeys.size()));
  return drawn;
}

std::string svg_sheet(const FloorPlan& plan, const DrawnPlan& drawn, const Sheet& sheet, const SheetNotes& notes) {
  const auto& storeys = drawn.storeys;
  TitleBlock block{notes.title, note_of(plan, drawn.turn) + notes.remark, 0, storeys.size()};
  block.north = -drawn.turn;
  block.accuracy = notes.accuracy;
  SvgCanvas canvas(sheet.size.x(), sheet.size.y(), notes.title);
  canvas.raw(hatch);
  for (std::size_t i = 0; i < storeys.size(); ++i) {
    block.inferred = draw_storey(canvas, sheet, i, storeys[i], notes.dimensions) || block.inferred;
    block.rooms += storeys[i].rooms.size();
    block.corrected = block.corrected || has_corrections(storeys[i]);
    for (const auto& room : storeys[i].rooms) block.area += room.polygon.area();
  }
  if (storeys.empty())
    canvas.text(0.5 * sheet.size, 4, "The plan is empty: no walls, floors or ceilings.", "text-anchor=\"middle\"");
  draw_title(canvas, sheet, block);
  return std::move(canvas).finish();
}

}  // namespace atrium::floorplan
