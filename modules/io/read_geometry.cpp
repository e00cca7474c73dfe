#include "modules/io/read_geometry.hpp"

#include <fmt/format.h>

#include "graph/api/error.hpp"
#include "modules/io/mapped_file.hpp"
#include "modules/io/paths.hpp"
#include "modules/io/ply_reader.hpp"

namespace atrium::io {
namespace {

RawGeometry read(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string extension = extension_of(file->path());
  const std::string_view text = file->text();
  if (text.starts_with("ply\n") || text.starts_with("ply\r") || extension == ".ply") return read_ply(file, context);
  throw Error(file->path() + ": unknown format '" + extension + "'", "known: .ply");
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
