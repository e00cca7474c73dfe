#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/metric/welded_mesh.hpp"

namespace atrium::metric {

/// How two triangles meet, decided without rounding error.
enum class Meeting {
  apart,     ///< nowhere, or only at borders: in a point, along an edge, an edge of one in the middle of the other
  crossing,  ///< their insides cross along a segment
  overlap    ///< they lie in one plane and their insides share area
};
/// Neither triangle may be without area.
Meeting meeting(const std::array<Eigen::Vector3d, 3>& a, const std::array<Eigen::Vector3d, 3>& b);

/// How far two crossing triangles reach through each other's plane: the least of the four reaches, to either side of
/// either plane.
double crossing_depth(const std::array<Eigen::Vector3d, 3>& a, const std::array<Eigen::Vector3d, 3>& b);

struct SelfIntersections {
  std::size_t crossings = 0, deep_crossings = 0, overlaps = 0;
  std::vector<std::uint32_t> triangles;  ///< that have a part in any, ascending
};
/// Pairs of triangles that cross or overlap; `deep` ones by more than that depth, in metres. Triangles with the same
/// three corners are no pair. None may be without area.
SelfIntersections self_intersections(const std::vector<Eigen::Vector3d>& vertices,
                                     const std::vector<Triangle>& triangles, double deep, const Context& context);

}  // namespace atrium::metric
