#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/synth/scan.hpp"

namespace atrium::synth {

struct Station {
  Eigen::Vector3d place;
  Eigen::Isometry3d drift = Eigen::Isometry3d::Identity();  ///< true place to where the scanner puts it
  Eigen::Vector3d heading = Eigen::Vector3d::Zero();        ///< where its carrier walks to, level; zero on a tripod
};

/// Where tripods stand: the first `positions` of each room, `most_positions` in all, and each one's drift. Errors:
/// none.
std::vector<Station> tripods(const SimulatedScene& scene, const Scan::Params& params, Random random);

/// A walk past the same places, through doors and over stairs, 1.4 m above the floors and at least 0.2 m from all that
/// `obstacles` holds, where there is a way; between storeys without stairs it jumps. A place every 10 cm.
/// Deterministic.
std::vector<Station> walk(const SimulatedScene& scene, const TriangleTree& obstacles, const Scan::Params& params,
                          Random random);

}  // namespace atrium::synth
