#include "modules/io/read_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "graph/api/error.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/e57_reader.hpp"
#include "modules/io/las_reader.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/obj_reader.hpp"
#include "modules/io/paths.hpp"
#include "modules/io/pcd_reader.hpp"
#include "modules/io/ply_header.hpp"
#include "modules/io/ply_reader.hpp"
#include "modules/io/ptx_reader.hpp"
#include "modules/io/stl_reader.hpp"
#include "modules/io/text_reader.hpp"

namespace atrium::io {
namespace {

/// Formats of makers that only their programs read: says what to export from them.
void refuse_vendors(const std::string& path, const std::string& extension) {
  struct Vendor {
    std::string_view extension, format, program;
  };
  static constexpr Vendor vendors[] = {
      {".rcp", "a project of Autodesk ReCap", "ReCap Pro"},
      {".rcs", "a scan of Autodesk ReCap", "ReCap Pro"},
      {".rvt", "a model of Autodesk Revit", "ReCap Pro (the scans that it was made of)"},
      {".fls", "a scan of FARO", "FARO SCENE"},
      {".lsproj", "a project of FARO", "FARO SCENE"},
      {".zfs", "a scan of Zoller + Fröhlich", "Z+F LaserControl"},
      {".lgs", "a scan of Leica", "Leica Cyclone"},
      {".lgsx", "a scan of Leica", "Leica Cyclone"},
      {".imp", "a database of Leica Cyclone", "Leica Cyclone"},
      {".blk", "a scan of Leica BLK", "Leica Cyclone"},
      {".rdbx", "a scan of RIEGL", "RiSCAN PRO"},
      {".3dd", "a scan of RIEGL", "RiSCAN PRO"},
      {".rsp", "a project of RIEGL", "RiSCAN PRO"},
      {".tzf", "a scan of Trimble", "Trimble RealWorks"},
      {".rwp", "a project of Trimble", "Trimble RealWorks"},
      {".cl3", "a scan of Topcon", "ScanMaster"},
      {".pod", "a point cloud of Bentley", "Bentley Pointools"},
      {".bin", "a project of CloudCompare", "CloudCompare"}};
  for (const auto& vendor : vendors)
    if (extension == vendor.extension)
      throw Error(fmt::format("{}: {}, which only its maker's programs read", path, vendor.format),
                  fmt::format("export the scan as E57 from {}", vendor.program));
}

/// What has no extension, as a pipe, and does not begin as a format does.
RawGeometry read_unnamed(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string_view start = file->text().substr(0, 4096);
  if (begins_as_stl_text(start)) return read_stl(file, context);
  bool is_obj = false;
  for_lines(without_mark(start), [&](std::string_view line) {
    const std::string keyword = lower_case(next_token(line));
    is_obj = is_obj || keyword == "v" || keyword == "mtllib";
    return !is_obj;
  });
  if (is_obj) return read_obj(file, context);
  if (start.find('\0') == std::string_view::npos) return read_text(file, context);
  throw Error(file->path() + ": unknown format: it has no extension, and its beginning shows none",
              "give a file whose name ends with its format");
}

RawGeometry read(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string extension = extension_of(file->path());
  const auto is = [&](std::initializer_list<std::string_view> known) {
    return std::find(known.begin(), known.end(), extension) != known.end();
  };
  const std::string_view text = file->text();
  if (is({".e57"}) || text.starts_with("ASTM-E57")) return read_e57(file, context);
  if (is({".las", ".laz"}) || text.starts_with("LASF")) return read_las(file, context);
  if (is({".ply"}) || begins_as_ply(text)) return read_ply(file, context);
  if (is({".pcd"}) || without_mark(text).starts_with("# .PCD")) return read_pcd(file, context);
  if (is({".obj"})) return read_obj(file, context);
  if (is({".stl"})) return read_stl(file, context);
  if (is({".ptx"}) || is_ptx(text)) return read_ptx(file, context);
  refuse_vendors(file->path(), extension);
  if (is({".xyz", ".txt", ".pts", ".csv", ".asc", ".xyzrgb", ".xyzn"})) return read_text(file, context);
  if (extension.empty()) return read_unnamed(file, context);
  throw Error(fmt::format("{}: unknown format '{}'", file->path(), extension),
              "known: .e57, .las, .laz, .ptx, .ply, .pcd, .obj, .stl, and text as .xyz, .txt, .pts, .csv, .asc, .xyzn, "
              ".xyzrgb");
}

}  // namespace

RawGeometry read_geometry(const std::string& path, const Context& context) {
  const auto file = std::make_shared<const MappedFile>(path);
  if (file->size() == 0)
    throw Error(path + (file->is_pipe() ? ": nothing came through the pipe" : ": the file is empty"));
  RawGeometry geometry = read(file, context);
  if (geometry.skipped_faces > 0)
    context.warn(fmt::format("{}: {} faces of fewer than three corners skipped", path, geometry.skipped_faces));
  return geometry;
}

}  // namespace atrium::io
