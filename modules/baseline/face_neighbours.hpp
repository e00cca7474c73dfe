#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// For each triangle and each of its edges k (from corner k to corner k + 1) the triangle on the other side.
struct FaceNeighbours {
  static constexpr std::uint32_t none = 0xffffffffU;     ///< a border of the mesh
  static constexpr std::uint32_t several = 0xfffffffeU;  ///< an edge of more than two triangles
  std::vector<std::array<std::uint32_t, 3>> of;
};

/// Corners must be vertices; triangles with a repeated corner have neighbours like all others.
FaceNeighbours face_neighbours(const Mesh& mesh, const Context& context);

}  // namespace atrium::baseline
