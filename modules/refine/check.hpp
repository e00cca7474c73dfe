#pragma once
#include "modules/types/adjacency.hpp"
#include "modules/types/plane_meshes.hpp"

namespace atrium::refine {

/// Error unless the graph has one vertex for each mesh.
void check_matches(const Adjacency& adjacency, const PlaneMeshes& meshes);

}  // namespace atrium::refine
