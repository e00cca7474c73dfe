#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads the meshes of a glTF 2.0 file, .glb or .gltf, where its nodes put them: triangles, strips, fans, and points;
/// lines are passed over, said. Corners at exactly the same place become one vertex, with the normal and the colour of
/// the first: glTF has them apart wherever those differ. Colours are those of the vertices (COLOR_0) times the
/// material's base colour, and its image there, as sRGB; files without any give none. Files of io.write_mesh come back
/// in the frame that they were written from, with classes, storeys and primitives; others as they are, y up. Compressed
/// meshes (Draco, meshopt) are refused. Throws Error with the byte or the JSON's key.
RawGeometry read_gltf(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
