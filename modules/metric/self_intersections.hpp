#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/metric/triangle_meeting.hpp"
#include "modules/metric/welded_mesh.hpp"

namespace atrium::metric {

struct SelfIntersections {
  std::size_t crossings = 0, deep_crossings = 0, overlaps = 0, touches = 0;  ///< pairs of triangles
  std::size_t through_edges = 0;         ///< edges along which a surface passes through another, see metric.validity
  std::vector<std::uint32_t> triangles;  ///< that have a part in any, ascending
};
/// Pairs of triangles that cross, overlap or touch; `deep` ones cross by more than that depth, in metres. Triangles
/// with the same three corners are no pair. None may be without area, and no two vertices that they use at the same
/// place. Where two surfaces pass through each other, some pair crosses or overlaps, some edge is a through edge, or
/// both have an edge in common: between two closed ones the curve in which they cross runs in the insides of two faces
/// (crossing), along an edge in the inside of a face or along two edges (through), or along an edge that has four
/// faces.
SelfIntersections self_intersections(const std::vector<Eigen::Vector3d>& vertices,
                                     const std::vector<Triangle>& triangles, double deep, const Context& context);

}  // namespace atrium::metric
