#pragma once
#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::normal {

/// Turns the normals of a cloud to the side of the free space (see normal.orient, inside). Lengths in metres.
void turn_to_free_space(Cloud& cloud, double voxel, double range, const Context& context);

}  // namespace atrium::normal
