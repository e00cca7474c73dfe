#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace atrium::io {

/// A face of more than three corners: the first of its triangles, which are a fan around its first corner.
struct FaceFan {
  std::size_t first = 0, corners = 0;
};

/// Cuts the faces that are not convex by their ears instead: a fan covers what lies outside of them. Faces are taken
/// for flat, as Newell's normal has them; those without an area stay as they are. `vertices` in any unit; triangles
/// keep their number and order. Cost: linear, quadratic in the corners of a face that is not convex.
void cut_concave_faces(const std::vector<Eigen::Vector3d>& vertices, const std::vector<FaceFan>& fans,
                       std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace atrium::io
