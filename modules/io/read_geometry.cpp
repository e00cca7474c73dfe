#include "modules/io/read_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "graph/api/error.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/obj_reader.hpp"
#include "modules/io/paths.hpp"
#include "modules/io/pcd_reader.hpp"
#include "modules/io/ply_reader.hpp"
#include "modules/io/stl_reader.hpp"
#include "modules/io/text_reader.hpp"

namespace atrium::io {
namespace {

RawGeometry read(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string extension = extension_of(file->path());
  const auto is = [&](std::initializer_list<std::string_view> known) {
    return std::find(known.begin(), known.end(), extension) != known.end();
  };
  const std::string_view text = file->text();
  if (is({".ply"}) || text.starts_with("ply\n") || text.starts_with("ply\r")) return read_ply(file, context);
  if (is({".pcd"}) || text.starts_with("# .PCD")) return read_pcd(file, context);
  if (is({".obj"})) return read_obj(file, context);
  if (is({".stl"})) return read_stl(file, context);
  if (is({".xyz", ".txt", ".pts", ".csv", ".asc", ".xyzrgb", ".xyzn"})) return read_text(file, context);
  throw Error(fmt::format("{}: unknown format '{}'", file->path(), extension),
              "known: .ply, .pcd, .obj, .stl, and text as .xyz, .txt, .pts, .csv, .asc, .xyzn, .xyzrgb");
}

}  // namespace

RawGeometry read_geometry(const std::string& path, const Context& context) {
  const auto file = std::make_shared<const MappedFile>(path);
  if (file->size() == 0) throw Error(path + ": the file is empty");
  RawGeometry geometry = read(file, context);
  if (geometry.skipped_faces > 0)
    context.warn(fmt::format("{}: {} faces of fewer than three corners skipped", path, geometry.skipped_faces));
  return geometry;
}

}  // namespace atrium::io
