#include "modules/io/vg_file.hpp"

#include <fmt/format.h>

#include "graph/api/error.hpp"

namespace atrium::io {
namespace {

void read_column(VgStream& stream, std::string_view what, const std::vector<Role>& roles, std::uint64_t count,
                 RawGeometry& geometry) {
  if (count == 0) return;
  if (count != geometry.count)
    throw Error(fmt::format("{}: {} is {}, but there are {} points (it has to be 0 or the same)", stream.where(), what,
                            count, geometry.count));
  auto table = std::make_shared<Table>(count, roles);
  for (std::uint64_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < 3; ++a) table->row(i)[a] = stream.number(what);
  Table::attach(std::move(table), geometry);
}

VgGroup read_group(VgStream& stream, std::uint64_t points) {
  VgGroup group;
  stream.name("group_type");
  group.type = stream.index("group_type");
  const std::uint64_t parameters = stream.count("num_group_parameters", 1);
  stream.name("group_parameters");
  std::array<double, 4> plane{};
  for (std::uint64_t k = 0; k < parameters; ++k) {
    const double v = stream.number("group_parameters");
    if (k < 4) plane[k] = v;
  }
  if (parameters == 4) group.plane = plane;
  stream.label();
  stream.name("group_color");
  for (int a = 0; a < 3; ++a) stream.number("group_color");
  const std::uint64_t count = stream.count("group_num_points", 1);
  group.points.reserve(count);
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::int64_t index = stream.index("a point's index");
    if (index < 0 || static_cast<std::uint64_t>(index) >= points)
      throw Error(fmt::format("{}: a group has the point {}, but there are {} (0 to {})", stream.where(), index, points,
                              points == 0 ? 0 : points - 1));
    group.points.push_back(static_cast<std::uint32_t>(index));
  }
  return group;
}

}  // namespace

VgFile read_vg_file(VgStream& stream, const std::string& path) {
  constexpr std::size_t least_group = 8;  // numbers: type, counts, label, colour …
  VgFile file;
  file.geometry.path = path;
  file.geometry.count = stream.count("num_points", 3);
  if (file.geometry.count < 3)
    throw Error(fmt::format("{}: {} points", path, file.geometry.count),
                "three points are the least that define a plane");
  read_column(stream, "num_points", {Role::x, Role::y, Role::z}, file.geometry.count, file.geometry);
  read_column(stream, "num_colors", {Role::red, Role::green, Role::blue}, stream.count("num_colors", 3), file.geometry);
  read_column(stream, "num_normals", {Role::nx, Role::ny, Role::nz}, stream.count("num_normals", 3), file.geometry);
  const std::uint64_t groups = stream.count("num_groups", least_group);
  for (std::uint64_t g = 0; g < groups; ++g) {
    file.groups.push_back(read_group(stream, file.geometry.count));
    const std::uint64_t children = stream.count("num_children", least_group);
    for (std::uint64_t c = 0; c < children; ++c) file.groups.push_back(read_group(stream, file.geometry.count));
  }
  return file;
}

}  // namespace atrium::io
