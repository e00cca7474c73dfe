#include "modules/io/pcd_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "graph/api/error.hpp"
#include "modules/io/free_numbers.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/lzf.hpp"
#include "modules/io/pcd_header.hpp"

namespace atrium::io {
namespace {

constexpr bool swapped = std::endian::native == std::endian::big;  // PCD files hold little-endian numbers

/// The field's role: none for the fields that cannot have it (several numbers, a role already taken).
Role pcd_role_of(const PcdField& field, const RawGeometry& geometry) {
  const Role role = io::role_of(field.name);
  if (role == Role::none || field.count != 1 || geometry.column(role)) return Role::none;
  return role == Role::packed_colour && size_of(field.type) != 4 ? Role::none : role;
}

void set_column(const PcdField& field, const std::byte* data, std::size_t stride, RawGeometry& geometry) {
  const Role role = pcd_role_of(field, geometry);
  if (role == Role::none) return;
  // A packed colour declared as float is the same four bytes.
  const Scalar type = role == Role::packed_colour ? Scalar::u32 : field.type;
  geometry.column(role) = {data, stride, type, swapped};
}

void read_binary(const MappedFile& file, const PcdHeader& header, RawGeometry& geometry) {
  const std::size_t left = file.size() - header.body;
  if (header.record == 0 || header.points > left / header.record)
    throw Error(fmt::format("{}: truncated: {} points of {} bytes are to follow byte {}, but the file has {} bytes",
                            file.path(), header.points, header.record, header.body, file.size()),
                "the header promises more than the file holds: copy or export it again");
  for (const auto& field : header.fields)
    set_column(field, file.data() + header.body + field.offset, header.record, geometry);
}

/// Field after field: all x, all y …
void read_compressed(const MappedFile& file, const PcdHeader& header, RawGeometry& geometry) {
  const std::size_t left = file.size() - header.body;
  if (left < 8)
    throw Error(fmt::format("{}: truncated: the two sizes are to follow byte {}, but the file has {} bytes",
                            file.path(), header.body, file.size()));
  const std::byte* start = file.data() + header.body;
  const std::size_t packed = load<std::uint32_t>(start, swapped);
  const std::size_t size = load<std::uint32_t>(start + 4, swapped);
  if (packed > left - 8)
    throw Error(fmt::format("{}: truncated: {} compressed bytes are to follow byte {}, but the file has {} bytes",
                            file.path(), packed, header.body + 8, file.size()));
  if (header.record == 0 || header.points > size / header.record || header.points * header.record != size)
    throw Error(fmt::format("{}: {} points of {} bytes are declared, but {} bytes are compressed (byte {})",
                            file.path(), header.points, header.record, size, header.body + 4));
  auto data = std::make_shared<std::vector<std::byte>>();
  if (!expand_lzf(start + 8, packed, *data, size))
    throw Error(fmt::format("{}: the compressed data from byte {} on are damaged", file.path(), header.body + 8));
  std::size_t offset = 0;
  for (const auto& field : header.fields) {
    set_column(field, data->data() + offset, field.size(), geometry);
    offset += field.size() * header.points;
  }
  geometry.storage.push_back(std::move(data));
}

/// The bits of a packed colour that is written as a number: of a float its own bits, as PCL keeps them, which with a
/// colour in them are far below 1; as other programs write it, the whole number.
double packed_bits(double value, Scalar type) {
  constexpr double most = 4294967295.0;
  if (value < 0 && value >= -2147483648.0 && value == std::floor(value)) value += most + 1;  // opaque, as an i32
  if (!std::isfinite(value)) return 0;  // as some programs write points without a colour
  const bool whole = value >= 1 && value <= most && value == std::floor(value);
  if (whole) return value;
  return type == Scalar::f32 ? std::bit_cast<std::uint32_t>(static_cast<float>(value)) : 0.0;
}

void read_row(const MappedFile& file, const PcdHeader& header, const std::vector<Role>& roles, const Row& row,
              double* to) {
  std::string_view rest = row.text;
  for (std::size_t f = 0; f < header.fields.size(); ++f) {
    const PcdField& field = header.fields[f];
    for (std::uint64_t k = 0; k < field.count; ++k) {
      const std::string_view token = next_token(rest);
      double v = 0;
      if (token.empty())
        throw Error(fmt::format("{}:{}: the line ends before '{}'", file.path(), row.line, field.name));
      if (!parse_number(token, v))
        throw Error(fmt::format("{}:{}: {} ('{}')", file.path(), row.line, no_number(token), field.name));
      if (roles[f] != Role::none) *to++ = roles[f] == Role::packed_colour ? packed_bits(v, field.type) : v;
    }
  }
  if (const std::string_view token = next_token(rest); !token.empty())
    throw Error(fmt::format("{}:{}: {} fields are declared, but {} follows", file.path(), row.line,
                            header.fields.size(), quote(token)));
}

void read_rows(const MappedFile& file, std::string_view text, const PcdHeader& header, RawGeometry& geometry,
               const Context& context) {
  const Lines lines(text, header.lines + 1, true, context);
  if (lines.rows() < header.points)
    throw Error(fmt::format("{}: truncated: {} points are declared, but the file ends after {} (line {})", file.path(),
                            header.points, lines.rows(), lines.end_line()),
                "the header promises more than the file holds: copy or export it again");
  std::vector<Role> roles;
  std::vector<Role> kept;
  for (const auto& field : header.fields) {
    const Role role = pcd_role_of(field, geometry);
    roles.push_back(std::find(kept.begin(), kept.end(), role) == kept.end() ? role : Role::none);
    if (roles.back() != Role::none) kept.push_back(role);
  }
  auto table = std::make_shared<Table>(header.points, kept);
  lines.for_rows(0, header.points, context,
                 [&](std::size_t, const Row& row) { read_row(file, header, roles, row, table->row(row.index)); });
  Table::attach(std::move(table), geometry);
  for (std::size_t f = 0; f < roles.size(); ++f)
    if (roles[f] != Role::none) geometry.column(roles[f]).whole = !is_floating(header.fields[f].type);
}

/// The points with one a line, if they are broken into lines in another way.
std::optional<std::string> one_point_a_line(std::string_view text, const PcdHeader& header) {
  std::uint64_t width = 0;
  for (const auto& field : header.fields) width += field.count;
  if (width == 0) return std::nullopt;
  FreeNumbers numbers(text);
  double value = 0;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    for (std::uint64_t k = 0; k < width; ++k)
      if (!numbers.take(value)) return std::nullopt;
    numbers.end_record();
  }
  return numbers.text();
}

void read_text_pcd(const MappedFile& file, const PcdHeader& header, RawGeometry& geometry, const Context& context) {
  const std::string_view text = file.text().substr(header.body);
  try {
    read_rows(file, text, header, geometry, context);
  } catch (const Error&) {
    const auto other = one_point_a_line(text, header);
    if (!other) throw;
    read_rows(file, *other, header, geometry, context);
  }
}

}  // namespace

RawGeometry read_pcd(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const PcdHeader header = read_pcd_header(*file);
  RawGeometry geometry;
  geometry.path = file->path();
  geometry.count = header.points;
  geometry.viewpoint = header.viewpoint;
  if (header.height > 1) geometry.image_width = header.width;
  geometry.storage.push_back(file);
  if (header.points == 0) return geometry;
  if (header.data == PcdHeader::Data::ascii)
    read_text_pcd(*file, header, geometry, context);
  else if (header.data == PcdHeader::Data::binary)
    read_binary(*file, header, geometry);
  else
    read_compressed(*file, header, geometry);
  std::string names;
  for (const auto& field : header.fields) names += (names.empty() ? "" : ", ") + field.name;
  require_position(geometry, names);
  return geometry;
}

}  // namespace atrium::io
