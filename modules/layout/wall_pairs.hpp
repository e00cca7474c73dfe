#pragma once
#include <vector>

#include "modules/types/building.hpp"

namespace atrium::layout {

/// Faces that look away from each other (to within wall_parallel_angle) at most max_thickness apart and lie over each
/// other: the two sides of walls, and floors over ceilings. Area and thickness are those of what their polygons, seen
/// along the first face's normal, have in common. By ascending face numbers.
std::vector<BuildingWall> wall_pairs(const Building& building, double max_thickness);

/// Whether a place in a face's plane lies in its polygon, or at most `margin` outside of its box.
bool face_contains(const Building& building, const BuildingFace& face, const Eigen::Vector3d& place, double margin);

}  // namespace atrium::layout
