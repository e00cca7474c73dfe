#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace atrium::render {

/// The box around triangles, without those that are far away from all others: farther from the box of the rest than
/// that is long, if they are less than 0.1 % of the whole area. Empty if there is no triangle.
Eigen::AlignedBox3d drawn_box(const std::vector<Eigen::Vector3f>& vertices,
                              const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace atrium::render
