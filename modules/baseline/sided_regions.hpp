#pragma once
#include "modules/types/mesh.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::baseline {

/// Gives the triangles of a closed polygonal surface their primitives and their front. `regions`: per triangle, which
/// connected planar piece it is of; a piece gets the primitive that has most inliers on it, or else the one whose plane
/// it lies in. Every closed part of the surface is turned in one piece so that it is seen from where its primitives
/// were seen. mesh.primitives is filled; only the first `used` primitives count.
void take_sides(Mesh& mesh, const std::vector<std::int32_t>& regions, const PlanePrimitives& planes, std::size_t used);

}  // namespace atrium::baseline
