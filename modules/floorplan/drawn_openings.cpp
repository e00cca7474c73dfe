#include "modules/floorplan/drawn_openings.hpp"

#include "modules/floorplan/door_leaf.hpp"

namespace atrium::floorplan {
namespace {

// A gap has its corners in the order from, to on the right of the opening, then to, from on its left.
void draw_window(SvgCanvas& canvas, const Pen& pen, const PlanRing& gap) {
  canvas.begin_group("fill=\"#fff\" stroke=\"#000\" stroke-width=\"0.25\"");
  pen.polygon({gap, {}});
  canvas.end_group();
  canvas.begin_group("fill=\"none\" stroke=\"#000\" stroke-width=\"0.18\"");
  for (const double share : {0.4, 0.6})
    pen.line(gap[0] + share * (gap[3] - gap[0]), gap[1] + share * (gap[2] - gap[1]));
  canvas.end_group();
}

void draw_door(SvgCanvas& canvas, const Pen& pen, const PlanOpening& door, const PlanRing& gap,
               const PlanStorey& storey) {
  const auto leaves = door_leaves(door, storey);
  canvas.begin_group("fill=\"#fbfaf7\" stroke=\"none\"");
  pen.polygon({gap, {}});
  canvas.end_group();
  // A passage without a leaf has its lintel dashed; a door a threshold.
  canvas.begin_group(leaves.empty()
                         ? "fill=\"none\" stroke=\"#8a8a8a\" stroke-width=\"0.18\" stroke-dasharray=\"1.2 0.8\""
                         : "fill=\"none\" stroke=\"#8a8a8a\" stroke-width=\"0.13\"");
  pen.line(gap[0], gap[1]);
  pen.line(gap[2], gap[3]);
  canvas.end_group();
  canvas.begin_group("fill=\"none\" stroke=\"#000\" stroke-width=\"0.35\"");
  pen.line(gap[1], gap[2]);
  pen.line(gap[3], gap[0]);
  for (const auto& leaf : leaves) pen.line(leaf.hinge, leaf.open);
  canvas.end_group();
  canvas.begin_group("fill=\"none\" stroke=\"#555\" stroke-width=\"0.15\"");
  for (const auto& leaf : leaves) pen.arc(leaf.closed, leaf.open, leaf.radius(), leaf.left());
  canvas.end_group();
}

void draw_slab(SvgCanvas& canvas, const Pen& pen, const PlanOpening& slab, const PlanStorey& storey) {
  const bool above = overhead(slab, storey);
  canvas.begin_group(above ? "fill=\"none\" stroke=\"#555\" stroke-width=\"0.2\" stroke-dasharray=\"2.4 1.2\""
                           : "fill=\"#fff\" stroke=\"#000\" stroke-width=\"0.25\"");
  pen.polygon({slab.outline, {}});
  canvas.end_group();
  if (above || slab.outline.size() != 4) return;
  canvas.begin_group("fill=\"none\" stroke=\"#555\" stroke-width=\"0.13\"");
  pen.line(slab.outline[0], slab.outline[2]);
  pen.line(slab.outline[1], slab.outline[3]);
  canvas.end_group();
}

}  // namespace

PlanRing gap_of(const PlanOpening& opening, double band) {
  const Eigen::Vector2d along = (opening.to - opening.from).normalized();
  const Eigen::Vector2d left(-along.y(), along.x());
  const double on_right = opening.thickness > 0 ? 0.5 * opening.thickness : band;
  const double on_left = opening.thickness > 0 ? 0.5 * opening.thickness : 0;
  return {opening.from - on_right * left, opening.to - on_right * left, opening.to + on_left * left,
          opening.from + on_left * left};
}

bool overhead(const PlanOpening& slab, const PlanStorey& storey) {
  return storey.height > 0 && slab.sill > 0.5 * storey.height;
}

void draw_openings(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey) {
  canvas.begin_group("class=\"openings\"");
  for (const auto& opening : storey.openings) {
    if (opening.kind == "slab") {
      if (opening.outline.size() >= 3) draw_slab(canvas, pen, opening, storey);
      continue;
    }
    if (!(opening.width() > 0)) continue;
    const PlanRing gap = gap_of(opening, hatch_width * pen.mm());
    if (opening.kind == "window")
      draw_window(canvas, pen, gap);
    else
      draw_door(canvas, pen, opening, gap, storey);
  }
  canvas.end_group();
}

}  // namespace atrium::floorplan
