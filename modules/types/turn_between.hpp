#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace atrium {

/// The least rotation that turns the direction `from` into the direction `to` (of any length, not zero); half a turn
/// about some axis across them where they are opposite. In place of Eigen's FromTwoVectors, which costs each file that
/// calls it seconds to compile.
Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace atrium
