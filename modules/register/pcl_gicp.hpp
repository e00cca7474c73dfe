#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace atrium::registration {

struct GicpSettings {
  double max_distance = 0.5;  ///< metres
  int iterations = 100;
  double translation_epsilon = 1e-4;  ///< metres
  double rotation_epsilon = 1e-4;     ///< radians
};
struct GicpResult {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< from source to target
  bool converged = false;
};

/// PCL's Generalized ICP. At least 20 points each.
GicpResult align_gicp(const std::vector<Eigen::Vector3f>& source, const std::vector<Eigen::Vector3f>& target,
                      const GicpSettings& settings);

}  // namespace atrium::registration
