#pragma once
#include <vector>

#include "modules/types/cloud.hpp"

namespace atrium::baseline {

/// Whether the point's normal is that of a floor or ceiling (|nz| of 0.8 at least); true for any point without normals.
bool is_level(const Cloud& cloud, std::size_t i);

/// Heights of floor and ceiling, metres above the cloud's origin.
struct StoreyHeights {
  double floor = 0, ceiling = 0;
};

/// Floor: the median of the points within 5 cm of the low percentile of all heights; ceiling: of the high one. Points
/// that look sideways are left out if there are normals. Error: fewer than 100 points, or less than a metre between.
StoreyHeights storey_heights(const Cloud& cloud, double percentile);

/// Where one storey ends and the next begins, ascending; none for one storey. In the profile of the level points'
/// heights (5 cm bins) a slab is a peak of what looks down and, at most 1 m above it, one of what looks up, with 1.8 m
/// of storey at least below and above. A peak has at least a fifth of the points of the greatest of its kind within
/// 10 cm. Without normals any level height is taken for both.
std::vector<double> storey_bounds(const Cloud& cloud);

/// The points from `low` up to `high` (not included), with their normals.
Cloud between_heights(const Cloud& cloud, double low, double high);

}  // namespace atrium::baseline
