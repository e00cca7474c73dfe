#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::io {

/// Writes a cloud in true coordinates (its origin added) with all of its columns, in the format that the path's
/// extension names: .ply and .pcd (binary or ascii), .e57, .las, .laz, .glb, .xyz and .txt (blanks), .csv (commas);
/// the last three begin with a line of column names.
///
/// Coordinates are float32 while the cloud's origin is 0, else double, so that georeferenced clouds keep their
/// millimetres (PCL's loaders want float32 in PCD). Colours are red, green, blue bytes (PCD: packed `rgb`), labels
/// int32, `source` ushort. One sensor is written as PCD's VIEWPOINT or PLY's element `camera`; several as PLY's element
/// `sensor` (double x, y, z) after the vertices, of which each vertex's `source` is the index: io.read_scan reads them
/// back, other programs pass over them. In PCD several, and in text, LAS and LAZ any sensors' places are not kept, with
/// a warning.
///
/// E57: a scan for each sensor, with its place as the scan's pose, so that the points come in the order of sensors.
/// LAS, LAZ: steps of 0.1 mm; labels 0 to 255 (LAZ: 31) as classification; intensities of 0 to 1 as 0 to 65535; no
/// normals; a warning for what is not kept. The cloud's reference system is written to these three, as WKT or GeoTIFF
/// keys, where its unit is the metre.
///
/// GLB is for viewers (atrium view, any of glTF's): places and colours only, places in whole millimetres (16 bits a
/// coordinate in tiles of 64 m; where a cloud is very wide, larger tiles and coarser steps), y up, in metres; of a
/// cloud without colours the intensities as greys. `transform` and `extras` are as with io.write_mesh.
///
/// `max_points`: of a cloud with more, so many are written, evenly in their order. Clouds of filter.voxel_grid are in
/// an order in which that thins them evenly in space.
///
/// Errors: unknown extension, a folder that cannot be written, GLB: coordinates that are not finite, more than 2 GiB;
/// then no file is there. An empty cloud gives a valid file
/// without points, and a warning.
struct WriteCloud {
  static constexpr std::string_view type = "io.write_cloud";
  static constexpr std::string_view summary = "Writes a cloud with all its columns to a file.";
  struct In {
    Input<Cloud> cloud;
    OptionalInput<Transform> transform;
  };
  struct Params {
    OutputPath path{"cloud.ply"};
    bool binary = true;
    std::int64_t max_points = 0;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::cloud>("What to write."),
                 port<&In::transform>("From the cloud's frame to one with z up, so that a .glb stands upright.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder; its extension is the format: .ply, .pcd, .e57, .las, .laz, "
                           ".glb, .xyz, .txt, .csv."),
      param<&Params::binary>("Binary where the format has both kinds (.ply, .pcd); else text."),
      param<&Params::max_points>(count, within(0, 1e9), "At most so many points are written; 0: all.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::io
