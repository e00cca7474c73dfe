#pragma once
#include <Eigen/Core>
#include <vector>

#include "modules/types/floor_plan.hpp"

/// Boost.Geometry's overlay of polygons in the plane, compiled in two files alone: it costs each file that calls it
/// more than ten seconds. Outlines are counter-clockwise, holes clockwise (corrected() turns them so), none repeats its
/// first corner. Lengths in metres. Cost: O(n log n) for n corners.
namespace atrium::overlay {

/// Each ring turned the way it has to run.
PlanPolygon corrected(const PlanPolygon& polygon);
/// No ring crosses or touches itself or another one along a line, holes are inside.
bool is_valid(const PlanPolygon& polygon);
/// Without the holes.
double area(const PlanPolygon& polygon);
double area(const std::vector<PlanPolygon>& polygons);
/// Of all of them together, whose area must be above 0.
Eigen::Vector2d centroid(const std::vector<PlanPolygon>& polygons);
/// Whether `part` lies in `whole`, its border included.
bool covers(const PlanPolygon& whole, const PlanPolygon& part);
/// What is in one of `polygons`, which do not overlap, and in `other`.
std::vector<PlanPolygon> intersection(const std::vector<PlanPolygon>& polygons, const PlanPolygon& other);
/// What is in one of `polygons` but not in `other`.
std::vector<PlanPolygon> difference(const std::vector<PlanPolygon>& polygons, const PlanPolygon& other);

}  // namespace atrium::overlay
