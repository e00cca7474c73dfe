#pragma once
#include <cstdint>

#include "graph/api/context.hpp"
#include "modules/baseline/face_neighbours.hpp"
#include "modules/baseline/planar_partition.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

struct CollapseLimits {
  std::size_t triangles = 0;  ///< ends when no more are left
  double max_error = 0;       ///< root mean square distance to the planes of a vertex, metres; 0: any
  double border_weight = 1;   ///< of the planes that hold borders, per squared length
  double max_projection = 0;  ///< further than this no vertex is moved onto its planes at first, metres
};

struct Collapsed {
  Mesh mesh;
  std::size_t with_borders = 0;  ///< triangles that were left before borders were given up; the target if they were not
  bool too_far = false;          ///< whether the largest error kept an edge at the end
};

/// Collapses edges by least error, and the partition stays what it is: a vertex inside a region may go anywhere in its
/// plane or into any neighbour, one on the border of two regions only along that border, one where three meet stays.
/// Where that does not reach the target, borders are given up too, again by least error: the planes and what holds
/// borders are still in it. An edge is kept if its collapse would change the topology (link condition) or turn a
/// triangle over. The result has the sources' columns and the regions as primitives.
Collapsed collapsed_by_planes(const Mesh& mesh, const FaceNeighbours& neighbours, const PlanarPartition& partition,
                              const CollapseLimits& limits, const Context& context);

}  // namespace atrium::baseline
