#pragma once
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::baseline {

/// Heights of floor and ceiling, metres above the cloud's origin.
struct StoreyHeights {
  double floor = 0, ceiling = 0;
};

struct DensityLimits {
  double percentile = 0.02;   ///< of the points' heights: where floor and ceiling are looked for
  double pixel = 0.04;        ///< metres
  double closing = 0.3;       ///< gaps of the ceiling up to twice this are closed, metres
  double min_coverage = 0.4;  ///< share of its height over which a wall's pixel was seen
  double min_room_area = 1;   ///< square metres
  double tolerance = 0.1;     ///< of Douglas and Peucker, metres
  double snap_angle = 20;     ///< degrees
  double reach = 0.15;        ///< metres
};

/// Floor: the median of the points within 5 cm of the low percentile of all heights; ceiling: of the high one. Points
/// that look sideways are left out if there are normals. Error: fewer than 100 points, or less than a metre between.
StoreyHeights storey_heights(const Cloud& cloud, double percentile);

/// One storey's rooms from a cloud with z up: where the ceiling was seen (it hides behind no furniture and ends at
/// lintels), less the pixels that are covered with points over the height (walls) or its part above doors (lintels),
/// each connected piece a room, its border straightened, its ceiling at the median height over it. Coordinates are
/// relative to the cloud's origin.
std::vector<PlanRoom> density_rooms(const Cloud& cloud, const StoreyHeights& heights, const DensityLimits& limits,
                                    const Context& context);

}  // namespace atrium::baseline
