#pragma once
#include <cstddef>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium {

/// Exactly `count` points spread over the surface of a mesh as evenly as blue noise: a Poisson-disk set by weighted
/// sample elimination (Yuksel, "Sample elimination for generating Poisson disk sample sets", 2015) from five times as
/// many uniform samples. Normals are those of the faces, colours are interpolated, the origin is the mesh's. Triangles
/// without area give no point. The same mesh, count and seed give the same points on any number of threads.
///
/// Throws Error if the mesh has no surface, a vertex that is not finite or a triangle that names a missing vertex.
Cloud sample_poisson_disk(const Mesh& mesh, std::size_t count, const Context& context);

}  // namespace atrium
