#pragma once
#include <vector>

#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// Areas of the plan: disjoint polygons, largest first, each ring beginning at its lowest corner (least x, then y).
/// Computed by Clipper (Vatti 1992) on whole tenths of a micrometre, so nothing is lost to rounding and equal input
/// gives equal output.
using Region = std::vector<PlanPolygon>;

/// What the rings cover, whatever their winding; rings of fewer than three corners cover nothing.
Region united(const std::vector<PlanRing>& rings);
Region joined(const Region& a, const Region& b);
Region minus(const Region& a, const Region& b);
Region common(const Region& a, const Region& b);
/// Grown by `distance` metres (shrunk if negative) with mitred corners.
Region grown(const Region& region, double distance);
/// Gaps narrower than `gap` closed.
Region closed(const Region& region, double gap);
/// Polygons whose parts hang together by a point or by a strip of no width become one polygon for each part, and rings
/// that enclose a hole that way get it as a hole; all others stay as they are, to the bit.
Region parted(const Region& region);
double area(const Region& region);

/// The rectangle of all points within `half_width` of the line from a to b, `beyond` longer at both ends.
PlanRing strip(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double half_width, double beyond);

}  // namespace atrium::floorplan
