#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/plane_primitives.hpp"
#include "modules/types/textures.hpp"

namespace atrium::io {

/// Writes a mesh in the format that the path's extension names. All formats but .glb have true coordinates (the mesh's
/// origin added).
///
/// .ply keeps everything: double coordinates, vertex colours, and per face `class` (0 object, 1 wall, 2 floor, 3
/// ceiling), `storey` and `primitive`, with the class's colour so that any viewer shows it. .obj keeps classes and
/// primitives as groups ("g wall_12") with a material of the class's colour in a .mtl file beside it; the images of
/// `textures` are files beside it, too: scene_wall_12.png of scene.obj. .stl keeps triangles only; its binary form has
/// float32, so a mesh further than 8192 m from zero is refused there.
///
/// .glb (glTF 2.0) is for viewers and modelling programs: metres, y up. Without `transform` z is up in the mesh's frame
/// (x, y, z stand as x, z, −y); with it, what is z after it: y up stays as it is, and a tilt of more than 5 degrees is
/// taken out, while a smaller one stays so that the file lies on the scan. It has a named node and mesh per class and
/// storey ("wall, storey 0"; "object"), in it a glTF primitive per source primitive with `extras` class, storey and
/// primitive, and a material per class in the class's colour. Faces of a plane have its normal; all else has none,
/// which glTF draws flat. Colours of vertices are written where they say more than the class. Structure is seen from
/// its front only, so that one looks into the rooms from outside; objects from both sides. As glTF has float32,
/// coordinates beyond a kilometre are shifted: `extras.origin` of the asset and of the scene says by how much, and
/// `extras.frame` how true coordinates follow (for z up: x = origin[0] + X, y = origin[1] − Z, z = origin[2] + Y).
/// glTF has no coordinate reference systems: `extras.crs` names that of true coordinates, as EPSG:25832, where it is
/// known (`crs`, or that of `scan`).
/// Faces that `textures` have an image for show it instead of the class's colour: unlit (KHR_materials_unlit), as PNG
/// in the same file.
///
/// Lengths are in `unit`, metres unless it is set. -s write_structure.unit=ft writes the file in feet, so that it lies
/// on a scan in feet.
///
/// An empty mesh gives a valid file without faces, and a warning. Errors: unknown extension, a mesh with coordinates
/// that are not finite, a texture without size, a .glb above 2 GiB, a folder that cannot be written; then no file is
/// there.
struct WriteMesh {
  static constexpr std::string_view type = "io.write_mesh";
  static constexpr std::string_view summary = "Writes a mesh with its classes to a file.";
  enum class Unit { metre, centimetre, millimetre, inch, foot };
  struct In {
    Input<Mesh> mesh;
    OptionalInput<Textures> textures;
    OptionalInput<Transform> transform;
    OptionalInput<Cloud> scan;
  };
  struct Params {
    OutputPath path{"mesh.ply"};
    bool binary = true;
    Unit unit = Unit::metre;
    std::string crs;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::mesh>("What to write."), port<&In::textures>("Images of its faces, for .glb and .obj."),
                 port<&In::transform>("From the mesh's frame to one with z up, so that a .glb stands upright."),
                 port<&In::scan>("The scan that it was made from: its coordinate reference system, for .glb.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder; its extension is the format: .ply, .obj, .stl, .glb."),
      param<&Params::binary>("Binary where the format has both kinds (.ply, .stl); else text."),
      param<&Params::unit>({{"m", Unit::metre},
                            {"cm", Unit::centimetre},
                            {"mm", Unit::millimetre},
                            {"in", Unit::inch},
                            {"ft", Unit::foot}},
                           "Unit of the coordinates in the file. A .glb is in metres always."),
      param<&Params::crs>("Coordinate reference system of the input, for .glb: EPSG:25832; empty: that of `scan`.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::io
