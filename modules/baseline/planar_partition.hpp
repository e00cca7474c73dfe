#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/baseline/face_neighbours.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::baseline {

/// The triangles of a mesh by the plane that they lie in.
struct PlanarPartition {
  std::vector<std::int32_t> region;  ///< per triangle: index into planes; -1: in none
  std::vector<Plane> planes;         ///< by falling area; normals to the side that sees triangles counter-clockwise
};

struct PartitionLimits {
  double distance = 0.02;  ///< of a triangle's corners to its plane, metres
  double angle = 25;       ///< of a triangle's smoothed normal to its plane's, degrees
  double min_area = 0.1;   ///< of a region, square metres
};

/// Regions grow over neighbouring triangles from the flattest places on, with a plane that is fitted to what they hold
/// so far. Then neighbouring regions of which one plane serves both become one, triangles beside a region that lie in
/// its plane join it whatever their normal, and borders are smoothed: a triangle goes to the region that two of its
/// neighbours are in, if it lies in that plane too.
PlanarPartition planar_partition(const Mesh& mesh, const FaceNeighbours& neighbours, const PartitionLimits& limits,
                                 const Context& context);

}  // namespace atrium::baseline
