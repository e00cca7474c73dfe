#include "modules/io/read_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "graph/api/error.hpp"
#include "graph/api/mapped_file.hpp"
#include "graph/api/text.hpp"
#include "modules/io/e57_reader.hpp"
#include "modules/io/gltf_file.hpp"
#include "modules/io/gltf_reader.hpp"
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

struct Vendor {
  std::string_view extension, format, program;
};
/// Formats of makers that only their programs read; null for others.
const Vendor* vendor_of(const std::string& extension) {
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
  const auto* found = std::find_if(std::begin(vendors), std::end(vendors),
                                   [&](const Vendor& vendor) { return vendor.extension == extension; });
  return found == std::end(vendors) ? nullptr : found;
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

using Reader = RawGeometry (*)(const std::shared_ptr<const MappedFile>&, const Context&);

bool is_one_of(const std::string& extension, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), extension) != known.end();
}

/// By what the file begins with, or by its extension; null if neither is that of a scan or mesh.
Reader reader_of(const MappedFile& file) {
  const std::string extension = extension_of(file.path());
  const auto is = [&](std::initializer_list<std::string_view> known) { return is_one_of(extension, known); };
  const std::string_view text = file.text();
  if (is({".e57"}) || text.starts_with("ASTM-E57")) return read_e57;
  if (is({".las", ".laz"}) || text.starts_with("LASF")) return read_las;
  if (text.starts_with("glTF")) return read_gltf;
  if (is({".ply"}) || begins_as_ply(text)) return read_ply;
  if (is({".pcd"}) || without_mark(text).starts_with("# .PCD")) return read_pcd;
  if (is({".glb", ".gltf"}) || begins_as_gltf(text)) return read_gltf;
  if (is({".obj"})) return read_obj;
  if (is({".stl"})) return read_stl;
  if (is({".ptx"}) || is_ptx(text)) return read_ptx;
  return nullptr;
}

bool is_text_extension(const std::string& extension) {
  return is_one_of(extension, {".xyz", ".txt", ".pts", ".csv", ".asc", ".xyzrgb", ".xyzn"});
}

RawGeometry read(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string extension = extension_of(file->path());
  if (const Reader reader = reader_of(*file)) return reader(file, context);
  if (const Vendor* vendor = vendor_of(extension))
    throw Error(fmt::format("{}: {}, which only its maker's programs read", file->path(), vendor->format),
                fmt::format("export the scan as E57 from {}", vendor->program));
  if (is_text_extension(extension)) return read_text(file, context);
  if (extension.empty()) return read_unnamed(file, context);
  throw Error(fmt::format("{}: unknown format '{}'", file->path(), extension),
              "known: .e57, .las, .laz, .ptx, .ply, .pcd, .glb, .gltf, .obj, .stl, and text as .xyz, .txt, .pts, .csv, "
              ".asc, .xyzn, .xyzrgb");
}

/// Whether one of the first lines has three numbers at least.
bool has_rows_of_numbers(std::string_view text) {
  constexpr int looked_at = 50;
  int lines = 0;
  bool found = false;
  for_lines(without_mark(text).substr(0, 65536), [&](std::string_view line) {
    std::string blanks(line);
    std::replace_if(
        blanks.begin(), blanks.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    std::string_view rest = blanks;
    int numbers = 0;
    double value = 0;
    for (auto token = next_token(rest); !token.empty(); token = next_token(rest))
      numbers += parse_number(token, value) ? 1 : 0;
    found = found || numbers >= 3;
    return !found && ++lines < looked_at;
  });
  return found;
}

}  // namespace

std::string why_no_scan(const std::string& path) {
  const MappedFile file(path, MappedFile::Kinds::regular);
  const std::string extension = extension_of(path);
  if (file.size() == 0) return "empty";
  if (reader_of(file) != nullptr) return "";
  if (const Vendor* vendor = vendor_of(extension))
    return fmt::format("{}: export it as E57 from {}", vendor->format, vendor->program);
  if (!is_text_extension(extension)) return "of another format";
  return has_rows_of_numbers(file.text()) ? "" : "no rows of numbers";
}

RawGeometry read_geometry(const std::string& path, const Context& context, Rows rows) {
  const auto file = std::make_shared<const MappedFile>(path);
  if (file->size() == 0)
    throw Error(path + (file->is_pipe() ? ": nothing came through the pipe" : ": the file is empty"));
  RawGeometry geometry = read(file, context);
  geometry.files.push_back(file);
  if (rows == Rows::loaded) load_rows(geometry, context);
  if (geometry.skipped_faces > 0)
    context.warn(
        fmt::format("{}: {} of fewer than three corners skipped", path, counted(geometry.skipped_faces, "face")));
  return geometry;
}

}  // namespace atrium::io
