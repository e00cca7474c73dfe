#pragma once
#include <filesystem>

#include "graph/api/context.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::io {

/// Throws Error unless every vertex is finite, every corner is a vertex and every column is empty or of full length.
void check_mesh(const Mesh& mesh);

/// PLY: vertices double x, y, z with the origin added (exact where georeferenced), colours if any; faces with `class`
/// (uchar, see the comments in the file), red, green, blue of the class, `storey` and `primitive` (int) as far as the
/// mesh has them.
void write_ply(const Mesh& mesh, bool binary, AtomicFile& file);

}  // namespace atrium::io
