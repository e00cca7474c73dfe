#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads a PLY file of any format, with any properties in any order, with or without faces. Polygons become fans of
/// triangles; strips of triangles (element `tristrips`) are read too. Elements, properties and lists that are not known
/// are skipped, with a warning if they have corners. The numbers of a text body may be broken into lines in any way.
/// The properties `class`, `storey` and `primitive` of faces are kept; an element `camera` (view_px, view_py, view_pz)
/// gives the viewpoint, an element `sensor` (x, y, z) several of them, of which the vertices' `source` names one.
/// Throws Error with line (ascii) or byte offset (binary).
RawGeometry read_ply(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
