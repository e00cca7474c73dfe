#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace atrium::layout {

using Ring = std::vector<std::uint32_t>;

/// The border of polygons of one plane, joined: sides that two of them run along in opposite directions cancel. Rings
/// are counter-clockwise around what was joined, holes clockwise, seen from where `normal` points to.
std::vector<Ring> joined_rings(const std::vector<Ring>& polygons, const std::vector<Eigen::Vector3d>& vertices,
                               const Eigen::Vector3d& normal);

/// Area of a ring, negative if it runs clockwise seen from where `normal` points to.
double signed_area(const Ring& ring, const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& normal);

/// Whether a place lies within a ring, both seen along `normal`.
bool ring_contains(const Ring& ring, const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& normal,
                   const Eigen::Vector3d& place);

/// Which vertices are no corners of these rings: each has the same two neighbours in all of them and lies within
/// `tolerance` of the straight edge that is left where it and others before it are dropped. Two corners of a millimetre
/// apart are one: one of them stays. Cost: linear.
std::vector<bool> straight_corners(const std::vector<const Ring*>& rings, const std::vector<Eigen::Vector3d>& vertices,
                                   double tolerance);

}  // namespace atrium::layout
