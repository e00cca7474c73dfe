#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "modules/types/plane_primitives.hpp"

namespace atrium::pcl_nodes {

/// Error if the cloud has fewer than 3 points, or no normals where they are wanted.
void check_planes_input(const Cloud& cloud, bool normals);

/// `asked`, but no less than 3; of 0 one in 2000 of the points, at least 50 (as plane.ransac has it).
std::size_t least_points_of_plane(const Cloud& cloud, int asked);

/// The points of each region as a primitive: its plane by least squares, turned to the mean of the points' normals
/// (without any: up, of an upright plane to +y, else +x). By falling number of inliers, regions of one size in their
/// order.
PlanePrimitives fitted_planes(const std::shared_ptr<const Cloud>& cloud,
                              std::vector<std::vector<std::uint32_t>> regions);

}  // namespace atrium::pcl_nodes
