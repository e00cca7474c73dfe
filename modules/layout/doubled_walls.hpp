#pragma once
#include <vector>

#include "modules/layout/raster.hpp"

namespace atrium::layout {

/// How much of the walls was seen twice: two layers that look the same way, close to each other. Nobody can see a wall
/// through another that stands before it, so that such a scan is made of parts that do not fit together.
struct DoubledWalls {
  double share = 0;   ///< of the area of the upright planes, 0 to 1
  double apart = 0;   ///< metres between the layers, the median
  double turned = 0;  ///< degrees between the layers, the median
};

/// `walls`: the footprints of the planes. Squares of 20 cm that are full of points are compared; layers are 4 to 35 cm
/// apart (more than four times the planes' residual) and up to 8° turned. Planes of less than 1 m² do not count. Time
/// grows with pairs of planes that lie close to each other.
DoubledWalls doubled_walls(const PlanePrimitives& planes, const std::vector<Footprint>& walls, const Context& context);

}  // namespace atrium::layout
