#pragma once
#include <Eigen/Core>
#include <vector>

namespace atrium {

/// Least distance between two segments in space (Ericson, Real-Time Collision Detection, 5.1.9).
double segment_distance(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1, const Eigen::Vector3d& b0,
                        const Eigen::Vector3d& b1);

/// Least distance between a segment and a planar convex polygon in space, its inside included: 0 if they touch or
/// cross.
double segment_polygon_distance(const Eigen::Vector3d& s0, const Eigen::Vector3d& s1,
                                const std::vector<Eigen::Vector3d>& polygon);

/// Least distance between two planar convex polygons in space, interiors included: 0 if they touch or cross. Any
/// winding; at least 3 corners each, not all on a line.
double polygon_distance(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b);

}  // namespace atrium
