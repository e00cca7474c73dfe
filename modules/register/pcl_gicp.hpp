#pragma once
#include "modules/register/register_scans.hpp"

namespace atrium::registration {

struct GicpSettings {
  double max_distance = 0.5;  ///< metres
  int iterations = 100;
  double translation_epsilon = 1e-4;  ///< metres
  double rotation_epsilon = 1e-4;     ///< radians
  int neighbours = 20;                ///< from which a point's covariance is taken (PCL's correspondence randomness)
  int optimizer_iterations = 20;      ///< of each round
};

/// PCL's Generalized ICP. At least 20 points each.
PairMotion align_gicp(const Points& source, const Points& target, const GicpSettings& settings);

}  // namespace atrium::registration
