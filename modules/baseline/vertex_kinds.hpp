#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/baseline/face_neighbours.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

constexpr std::int32_t outside = -2;  ///< the region beyond a border of the mesh

/// Between which regions a vertex lies: low == high inside of one, low < high on the border of two, `fixed` where more
/// meet, a border ends or the mesh is no manifold.
struct VertexKind {
  std::int32_t low = 0, high = 0;
  bool fixed = false;
};

/// The triangles at each vertex, ascending.
std::vector<std::vector<std::uint32_t>> faces_of_vertices(const Mesh& mesh);

std::vector<VertexKind> vertex_kinds(const Mesh& mesh, const std::vector<std::vector<std::uint32_t>>& faces,
                                     const FaceNeighbours& neighbours, const std::vector<std::int32_t>& region,
                                     const Context& context);

}  // namespace atrium::baseline
