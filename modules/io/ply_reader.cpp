#include "modules/io/ply_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/error.hpp"
#include "modules/io/ply_body.hpp"
#include "modules/io/ply_header.hpp"

namespace atrium::io {
namespace {

std::string names_of(const PlyElement& element) {
  std::string names;
  for (const auto& p : element.properties) names += (names.empty() ? "" : ", ") + p.name;
  return names;
}

}  // namespace

RawGeometry read_ply(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const PlyHeader header = read_ply_header(*file);
  RawGeometry geometry;
  geometry.path = file->path();
  geometry.storage.push_back(file);
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const PlyElement& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end()) throw Error(file->path() + ": the file has no element 'vertex', so no points");
  geometry.count = vertex->count;
  if (header.format == PlyHeader::Format::ascii)
    read_ply_text(*file, header, geometry, context);
  else
    read_ply_binary(*file, header, geometry);
  for (const auto& element : header.elements) warn_of_unread(file->path(), element, context);
  for (std::size_t i = 0; i < geometry.sensors.size(); ++i)
    if (!geometry.sensors[i].allFinite())
      throw Error(fmt::format("{}: the place of sensor {} is not finite", geometry.path, i));
  if (geometry.count > 0) require_position(geometry, names_of(*vertex));
  return geometry;
}

}  // namespace atrium::io
