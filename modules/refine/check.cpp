#include "modules/refine/check.hpp"

#include <fmt/format.h>

#include "graph/api/error.hpp"

namespace atrium::refine {

void check_matches(const Adjacency& adjacency, const PlaneMeshes& meshes) {
  const std::size_t vertices = adjacency.vertices();
  if (vertices != meshes.meshes.size())
    throw Error(
        fmt::format("the adjacency graph has {} vertices, but there are {} meshes", vertices, meshes.meshes.size()),
        "wire an adjacency that was made from these meshes, or from meshes in the same order");
}

}  // namespace atrium::refine
