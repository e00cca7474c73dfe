#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace atrium::io {

/// For each place the first one that is exactly the same (itself, if it is the first, or not finite); −0 is 0. Linear.
std::vector<std::uint32_t> first_at_same_place(const std::vector<Eigen::Vector3d>& places);

}  // namespace atrium::io
