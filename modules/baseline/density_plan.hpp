#pragma once
#include <vector>

#include "graph/api/context.hpp"
#include "modules/baseline/storey_heights.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::baseline {

struct DensityLimits {
  double percentile = 0.02;   ///< of the points' heights: where floor and ceiling are looked for
  double pixel = 0.04;        ///< metres
  double closing = 0.3;       ///< gaps of the ceiling up to twice this are closed, metres
  double min_coverage = 0.4;  ///< share of its height above doors over which a wall's pixel was seen
  double min_room_area = 1;   ///< square metres
  double tolerance = 0.1;     ///< of Douglas and Peucker, metres
  double snap_angle = 20;     ///< degrees
  double reach = 0.15;        ///< metres
};

/// One storey's rooms from a cloud with z up: where the ceiling was seen (it hides behind no furniture and ends at
/// lintels), less the pixels that are covered with points above doors and wardrobes (84 % of the height), each
/// connected piece a room. What stands free in it and is smaller than a room, and what stands out into it, up to six
/// pixels thick and 60 cm long, is no border. The border is straightened, the ceiling stands at the median height over
/// the room. Coordinates are relative to the cloud's origin.
std::vector<PlanRoom> density_rooms(const Cloud& cloud, const StoreyHeights& heights, const DensityLimits& limits,
                                    const Context& context);

}  // namespace atrium::baseline
