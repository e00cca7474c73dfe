#include "modules/io/cloud_columns.hpp"

#include <fmt/format.h>

#include <bit>
#include <iterator>

namespace atrium::io {
namespace {

std::string_view ply_type(Scalar type) {
  switch (type) {
    case Scalar::u8: return "uchar";
    case Scalar::u16: return "ushort";
    case Scalar::i32: return "int";
    case Scalar::f32: return "float";
    default: return "double";
  }
}

}  // namespace

void write_ply_head(const std::vector<OutColumn>& columns, std::size_t points, std::size_t sensors, bool binary,
                    ByteBuffer& out) {
  const char* format = !binary                                      ? "ascii"
                       : std::endian::native == std::endian::little ? "binary_little_endian"
                                                                    : "binary_big_endian";
  out.text(fmt::format("ply\nformat {} 1.0\ncomment Atrium; metres\nelement vertex {}\n", format, points));
  for (const auto& column : columns) out.text(fmt::format("property {} {}\n", ply_type(column.type), column.name));
  if (sensors == 1)
    out.text("element camera 1\nproperty double view_px\nproperty double view_py\nproperty double view_pz\n");
  if (sensors > 1)
    out.text(fmt::format("element sensor {}\nproperty double x\nproperty double y\nproperty double z\n", sensors));
  out.text("end_header\n");
}

std::vector<OutColumn> columns_of(const Cloud& cloud, bool packed_colour) {
  using Point = std::size_t;
  std::vector<OutColumn> columns;
  columns.reserve(12);
  const Scalar place = cloud.origin.isZero(0) ? Scalar::f32 : Scalar::f64;
  constexpr std::string_view axes[3] = {"x", "y", "z"};
  for (int a = 0; a < 3; ++a)
    columns.push_back(
        {axes[a], place, [&cloud, a](Point i) { return cloud.origin[a] + static_cast<double>(cloud.points[i][a]); }});
  constexpr std::string_view normals[2][3] = {{"nx", "ny", "nz"}, {"normal_x", "normal_y", "normal_z"}};
  for (int a = 0; !cloud.normals.empty() && a < 3; ++a)
    columns.push_back(
        {normals[packed_colour ? 1 : 0][a], Scalar::f32, [&cloud, a](Point i) { return cloud.normals[i][a]; }});
  if (!cloud.colours.empty() && packed_colour)
    columns.push_back({"rgb", Scalar::u32, [&cloud](Point i) {
                         const Colour& c = cloud.colours[i];
                         return c[0] * 65536.0 + c[1] * 256.0 + c[2];
                       }});
  constexpr std::string_view colours[3] = {"red", "green", "blue"};
  for (std::size_t a = 0; !cloud.colours.empty() && !packed_colour && a < 3; ++a)
    columns.push_back({colours[a], Scalar::u8, [&cloud, a](Point i) { return cloud.colours[i][a]; }});
  if (!cloud.intensities.empty())
    columns.push_back({"intensity", Scalar::f32, [&cloud](Point i) { return cloud.intensities[i]; }});
  if (!cloud.labels.empty()) columns.push_back({"label", Scalar::i32, [&cloud](Point i) { return cloud.labels[i]; }});
  if (!cloud.source.empty()) columns.push_back({"source", Scalar::u16, [&cloud](Point i) { return cloud.source[i]; }});
  return columns;
}

void write_records(const std::vector<OutColumn>& columns, std::size_t points, ByteBuffer& out) {
  for (std::size_t i = 0; i < points; ++i)
    for (const auto& column : columns)
      with_scalar(column.type, [&](auto t) { out.number(static_cast<decltype(t)>(column.value(i))); });
}

void write_lines(const std::vector<OutColumn>& columns, std::size_t points, char separator, ByteBuffer& out) {
  fmt::memory_buffer line;
  for (std::size_t i = 0; i < points; ++i) {
    line.clear();
    for (const auto& column : columns) {
      if (line.size() > 0) line.push_back(separator);
      const double v = column.value(i);
      if (column.type == Scalar::f32)
        fmt::format_to(std::back_inserter(line), "{}", static_cast<float>(v));
      else if (column.type == Scalar::f64)
        fmt::format_to(std::back_inserter(line), "{}", v);
      else
        fmt::format_to(std::back_inserter(line), "{}", static_cast<std::int64_t>(v));
    }
    line.push_back('\n');
    out.text({line.data(), line.size()});
  }
}

}  // namespace atrium::io
