#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::io {

/// Writes a mesh in true coordinates (its origin added), in the format that the path's extension names.
///
/// .ply keeps everything: double coordinates, vertex colours, and per face `class` (0 object, 1 wall, 2 floor, 3
/// ceiling), `storey` and `primitive`, with the class's colour so that any viewer shows it. .obj keeps classes and
/// primitives as groups ("g wall_12") with a material of the class's colour in a .mtl file beside it. .stl keeps
/// triangles only; its binary form has float32, so a mesh further than 8192 m from zero is refused there.
///
/// An empty mesh gives a valid file without faces, and a warning. Errors: unknown extension, a mesh with coordinates
/// that are not finite, a folder that cannot be written; then no file is there.
struct WriteMesh {
  static constexpr std::string_view type = "io.write_mesh";
  static constexpr std::string_view summary = "Writes a mesh with its classes to a file.";
  struct In {
    Input<Mesh> mesh;
  };
  struct Out {};
  struct Params {
    OutputPath path{"mesh.ply"};
    bool binary = true;
  };
  static constexpr auto inputs = std::tuple{port(&In::mesh, "mesh", "What to write.")};
  static constexpr auto outputs = std::tuple{};
  static constexpr auto params = std::tuple{
      param(&Params::path, "path", "The file, in the run's folder; its extension is the format: .ply, .obj, .stl."),
      param(&Params::binary, "binary", "Binary where the format has both kinds (.ply, .stl); else text.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::io
