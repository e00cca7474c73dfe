#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads a Wavefront OBJ file: `v` with or without colours (x y z r g b), `vn`, `f` with all forms of corners (1, 1/2,
/// 1//3, 1/2/3, 1//, negative ones counted back from the last vertex); polygons become fans of triangles. A vertex
/// takes the normal that its first corner names (without faces: normals go with vertices in order, if there are as
/// many). Groups named as io.write_mesh names them ("wall_12": class and primitive) are read back. Lines may go on
/// behind a backslash, and end with a comment. Lines of other keywords are skipped, with a warning if they are
/// surfaces. Throws Error with the line.
RawGeometry read_obj(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
