#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::object {

/// Fewer points than this are no surface: the mesh is empty.
constexpr std::size_t least_points = 10;

/// Whether there is anything to reconstruct: false, with a line in the log, if the cloud has fewer than least_points
/// points or all are in one place. Error if it has points but no normals.
bool is_surface(const Cloud& cloud, const Context& context);

/// How far apart the points of a surface are, metres: at the median of 10,000 places (or all), 1/√density from the
/// distance of the 16th neighbour, as if the surface were flat there. 0 where half of the points have 16 copies. At
/// least least_points points.
double surface_spacing(const Cloud& cloud, const Context& context);

/// Triangles in the cloud's local coordinates, as an algorithm gives them.
struct RawSurface {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Makes the mesh of a reconstruction: drops triangles that lie further than max_distance (metres) from the cloud with
/// a corner or with their middle, and the vertices that are then left over; gives each vertex the colour of its nearest
/// point. Classes are object, storeys and primitives −1.
Mesh finished(const RawSurface& surface, const Cloud& cloud, double max_distance, const Context& context);

}  // namespace atrium::object
