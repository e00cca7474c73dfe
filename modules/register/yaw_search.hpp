#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::registration {

/// Start poses for registering `source` to `target` (level scans, z up, metres), the most promising first, at most
/// `count`, different in yaw or place. Empty if a scan has no upright surface.
std::vector<Eigen::Isometry3d> search_yaw(const std::vector<Eigen::Vector3f>& source,
                                          const std::vector<Eigen::Vector3f>& target, std::size_t count,
                                          const Context& context);

}  // namespace atrium::registration
