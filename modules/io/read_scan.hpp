#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// Reads a scan.
///
/// Formats, found by what the file begins with, else by its extension: E57 (all scans, by their poses; cartesian,
/// spherical), LAS 1.0 to 1.4 (records 0 to 10), LAZ (records 0 to 3 and 6 to 8), PTX (several scans), PLY (ascii,
/// binary of either byte order), PCD, glTF (GLB and .gltf; y up as usual there), OBJ, STL and text (PTS of several
/// scans too). Colours, normals, intensities and labels are kept where the file has them for every point: colours of
/// E57 by their limits, of LAS in 16 or 8 bits; intensities of E57 as 0 to 1 where they have limits; classifications as
/// labels. Records that say that they are no points are left out: E57's invalid states, (0, 0, 0) in E57's and PTX's
/// grids, withheld points of LAS. Images in E57 are passed over. Files that only their makers' programs read (RCP, FLS,
/// ZFS and so on) are refused, saying what to export. Text may be spelled in any common way: lines that end with LF, CR
/// LF or CR, a byte order mark, capitals. What comes through a pipe is read whole, in the format that it begins with.
///
/// Several files. In brackets, files are joined to one scan: `-s scan="[a.e57, b.e57]"`; a pattern there stands for the
/// files that fit, `"[stations/*.e57]"`, and a folder for the scans in it, `"[stations]"`; what is no scan there is
/// passed over, and named in a warning. Brackets tell them from the scenes of a sweep file, where a folder or pattern
/// makes one scene of each file. All must be in one frame: reference systems and units that differ are errors. The
/// scanners' places of all are kept where every file says its own; columns where every file has them.
///
/// A mesh becomes points on its surface (paper, "Data set preparation": Poisson-disk samples, as many as it has
/// vertices).
///
/// Origin: on an axis whose median coordinate is further than 1000 m from zero, the cloud's origin is that median
/// rounded down to a whole metre, else 0. So georeferenced coordinates keep their millimetres in float32.
///
/// Unit: coordinates are times `unit` and `scale` in the cloud, which is in metres. With unit: auto it is what makes
/// rooms of the scan: heights of rooms and widths, doors, tables and seats, along each axis that may be up (see
/// align.gravity), and metres in nine files of ten. Metres stand unless another unit is clearly (4.5 times) more
/// likely; what was found, and what is in doubt, is a warning. E57 and PTX are in metres, and LAS in the unit of its
/// reference system, if it names one, text in that of its names ("X [ft]"). The reference system itself (WKT, EPSG
/// code) is kept in the cloud.
///
/// Any size: with `voxel` the points are thinned while they are read, to the same points as filter.voxel_grid gives
/// with that size. Memory then grows with the surface that was scanned, not with the points, which need 12 to 40 bytes
/// each. With `voxel_above` only large scans are thinned; that they are is a warning, as what is measured against the
/// points (building.accuracy) then tells of their means, which have less noise. Of dense scans noise and strays fill as
/// many voxels as surfaces do, each as heavy as one of theirs: `voxel_share` leaves them out.
///
/// Errors: file missing, empty, truncated or malformed (with line or byte), without points, with fewer than three
/// finite points. Warnings: points that are not finite (dropped), normals that are not (left out), a unit that is not
/// metres or in doubt, an extent that no interior has, float32 coordinates so far from zero that they lost millimetres,
/// many points in one place, colours above their range (cut), surfaces that are not read.
struct ReadScan {
  static constexpr std::string_view type = "io.read_scan";
  static constexpr std::string_view summary = "Reads a point cloud or mesh file as a cloud.";
  static constexpr bool random = true;  // only where the file is a mesh, which is sampled
  enum class MeshUse { sample, vertices };
  enum class SensorUse { automatic, origin, none };
  enum class Unit { automatic, metre, centimetre, millimetre, inch, foot };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    std::vector<InputPath> path;
    Unit unit = Unit::metre;
    double scale = 1.0;
    MeshUse mesh = MeshUse::sample;
    std::int64_t samples = 0;
    double spacing = 0;
    SensorUse sensor = SensorUse::automatic;
    double voxel = 0;
    std::int64_t voxel_above = 0;
    double voxel_share = 0;
  };
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The points, in the file's frame, in metres.")};
  static constexpr auto params = std::tuple{
      // At least one.
      ParamRow<Params, std::vector<InputPath>>{
          &Params::path, "path", unitless, at_least(1),
          "The file: .e57, .las, .laz, .ptx, .ply, .pcd, .glb, .gltf, .obj, .stl, or text: .xyz, .txt, .pts, .csv, "
          ".asc, .xyzn, .xyzrgb. Several in brackets are one scan: [a.e57, b.e57], [stations/*.e57], [FOLDER]."},
      param<&Params::unit>(
          {{"auto", Unit::automatic},
           {"m", Unit::metre},
           {"cm", Unit::centimetre},
           {"mm", Unit::millimetre},
           {"in", Unit::inch},
           {"ft", Unit::foot}},
          "Unit of the file's coordinates. auto: the one that makes rooms of the scan; only where `scale` is 1."),
      param<&Params::scale>(unitless, within(1e-9, 1e9), "A factor besides: from any other unit to the one of `unit`."),
      param<&Params::mesh>(
          {{"sample", MeshUse::sample}, {"vertices", MeshUse::vertices}},
          "What a file with faces gives: Poisson-disk samples of its surface (paper, \"Data set preparation\"), or its "
          "vertices as they are."),
      param<&Params::samples>(count, within(0, 4e9), "Number of samples of a mesh; 0: as `spacing` says."),
      param<&Params::spacing>(
          metres, within(0, 10),
          "Where `samples` is 0: a mesh gets one sample for each square this wide on its surface. 0: as many samples "
          "as "
          "it has vertices (the paper)."),
      param<&Params::sensor>(
          {{"auto", SensorUse::automatic}, {"origin", SensorUse::origin}, {"none", SensorUse::none}},
          "Where the scanner stood. auto: where the file says (poses of E57 and PTX, VIEWPOINT of PCD, camera of PLY; "
          "several places as io.write_cloud writes them to PLY), if that is not the all-zero default, which exported "
          "clouds have too; the file's origin if the points are one depth image (PCD with a height above 1) that was "
          "taken from there. origin: "
          "the file's origin. none: not known."),
      param<&Params::voxel>(
          metres, within(0, 100),
          "Edge of the voxels that points are joined in while they are read; 0: all points are kept. Not for meshes "
          "that are sampled."),
      param<&Params::voxel_above>(count, within(0, 4e9),
                                  "Only scans of more points are joined so; 0: all. Below, every point is kept."),
      param<&Params::voxel_share>(ratio, within(0, 1),
                                  "Voxels with less than this share of the points of the fullest one around them are "
                                  "noise and left out; 0: none. Where points are not joined it has no effect.")};
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::io
