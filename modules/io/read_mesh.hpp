#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::io {

/// Reads a triangle mesh: PLY, glTF (.glb, .gltf), OBJ, STL (formats as in io.read_scan). Polygons become fans of
/// triangles, and strips triangles. Vertices stay double; vertex colours are kept; `class`, `storey` and `primitive` of
/// the faces are read back from PLY (face properties), from .glb (extras) and, without storeys, from OBJ (groups
/// "wall_12"), as io.write_mesh wrote them.
///
/// glTF: all meshes of the scene that is shown first, where their nodes put them; triangles, strips and fans; corners
/// at the same place become one vertex. Colours are those of the vertices times the material's base colour and its
/// image there (PNG, JPEG), as sRGB. A
/// .glb of io.write_mesh comes back in the frame that it was written from; others as they are, with y up. Meshes that
/// are compressed (Draco, meshopt) are refused.
///
/// Origin: as in io.read_scan. Errors: file missing, empty, truncated or malformed (with line or byte). Warnings: faces
/// of fewer than three corners and triangles on vertices that are not finite (both left out), a mesh without triangles,
/// records with corners that are not read, float32 coordinates so far from zero that they lost millimetres.
struct ReadMesh {
  static constexpr std::string_view type = "io.read_mesh";
  static constexpr std::string_view summary = "Reads a triangle mesh from a file.";
  struct Out {
    Mesh mesh;
  };
  struct Params {
    InputPath path;
    double scale = 1.0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("The mesh, in the file's frame, in metres.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file: .ply, .glb, .gltf, .obj, .stl."),
      param<&Params::scale>(unitless, within(1e-9, 1e9),
                            "Factor from the file's unit to metres: 0.001 for millimetres, 0.3048 for feet.")};
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::io
