#pragma once
#include "modules/floorplan/plan_pen.hpp"

namespace atrium::floorplan {

/// Doors with their leaves, windows with their panes, holes in slabs (crossed; dashed where they are overhead).
void draw_openings(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey);

/// The gap that an opening leaves in its wall: its outline, or a band of that width behind the only face that is known.
PlanRing gap_of(const PlanOpening& opening, double band);

/// Whether it is a hole in the slab above: over half of the storey's height.
bool overhead(const PlanOpening& slab, const PlanStorey& storey);

}  // namespace atrium::floorplan
