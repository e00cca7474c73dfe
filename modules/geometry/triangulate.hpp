#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace atrium {

struct PlaneTriangles {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
};

/// Cuts a polygon with holes into triangles that meet edge to edge: bands between all heights at which a corner lies
/// (trapezoids), each cut from corner to corner. Exact: all points are corners of the rings or lie on their edges.
/// `rings`: simple, disjoint, in any order and direction; what is inside an odd number of rings is kept.
/// Rings that cross each other are no error: where they do, triangles are beside the polygon or lie over each other.
PlaneTriangles triangulate(const std::vector<std::vector<Eigen::Vector2d>>& rings);

}  // namespace atrium
