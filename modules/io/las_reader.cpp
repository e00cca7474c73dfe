#include "modules/io/las_reader.hpp"

#include <fmt/format.h>

#include <limits>

#include "graph/api/error.hpp"
#include "modules/io/las_source.hpp"

namespace atrium::io {

RawGeometry read_las(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const LasHeader header = read_las_header(*file);
  if (header.points == 0) throw Error(file->path() + ": no points: the file is empty but for its header");
  if (header.points > std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("{}: {} points; the most that can be handled are {}", file->path(), header.points,
                            std::numeric_limits<std::uint32_t>::max()));
  RawGeometry geometry;
  geometry.path = file->path();
  geometry.count = static_cast<std::size_t>(header.points);
  geometry.crs = header.crs.text;
  geometry.metres_per_unit = header.crs.metres;
  if (header.crs.degrees)
    context.warn(
        fmt::format("{}: its coordinates are longitude and latitude by its reference system ({}), not lengths: "
                    "project them first",
                    file->path(), header.crs.text.substr(0, 60)));
  geometry.source = std::make_shared<const LasSource>(file, header, context);
  return geometry;
}

}  // namespace atrium::io
