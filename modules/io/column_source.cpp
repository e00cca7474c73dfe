#include "modules/io/column_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/io/decode_columns.hpp"

namespace atrium::io {

ColumnSource::ColumnSource(const RawGeometry& geometry, const Context& context, Wanted wanted) : geometry_(geometry) {
  const auto provide_all = [&](std::initializer_list<Role> roles) {
    const bool all = std::all_of(roles.begin(), roles.end(), [&](Role r) { return is_there(r); });
    for (const Role role : roles)
      if (all) provide(role);
    return all;
  };
  provide_all({Role::x, Role::y, Role::z});
  if (wanted == Wanted::all) {
    provide_all({Role::nx, Role::ny, Role::nz});
    provide_all({Role::intensity});
    provide_all({Role::label});
    if (!geometry.sensors.empty()) provide_all({Role::source});
    if (provide_all({Role::red, Role::green, Role::blue})) {
      const bool bytes = geometry.column(Role::red).type == Scalar::u8 &&
                         geometry.column(Role::green).type == Scalar::u8 &&
                         geometry.column(Role::blue).type == Scalar::u8;
      colour_factor_ = bytes ? 1.0 : colour_factor(geometry, context);
    } else if (is_there(Role::packed_colour)) {
      packed_ = true;
      for (const Role role : {Role::red, Role::green, Role::blue}) provide(role);
    }
  }
  if (!geometry.rows) return;
  rows_wanted_ = geometry.rows->roles();
  for (Role& role : rows_wanted_)
    if (role != Role::none && !has(role) && !(packed_ && role == Role::packed_colour)) role = Role::none;
}

bool ColumnSource::is_there(Role role) const {
  if (!geometry_.rows) return bool(geometry_.column(role));
  const std::vector<Role>& roles = geometry_.rows->roles();
  return std::find(roles.begin(), roles.end(), role) != roles.end();
}

std::size_t ColumnSource::capacity(std::size_t block) const {
  return geometry_.rows ? geometry_.rows->rows(block) : std::min(block_size, geometry_.count - block * block_size);
}

void ColumnSource::read(std::size_t block, PointBlock& to) const {
  to.resize(capacity(block), roles());
  to.misses = 0;
  if (geometry_.rows) {
    RawGeometry parsed;
    Table::attach(geometry_.rows->read(block, rows_wanted_), parsed);
    fill(parsed, 0, to);
  } else {
    fill(geometry_, block * block_size, to);
    if (has(Role::source)) check_sources(block * block_size, to.of(Role::source), to.size);
  }
}

void ColumnSource::fill(const RawGeometry& columns, std::size_t first, PointBlock& to) const {
  constexpr Role colours[3] = {Role::red, Role::green, Role::blue};
  for (std::size_t r = 0; r < role_count; ++r) {
    const auto role = static_cast<Role>(r);
    const bool colour = role == Role::red || role == Role::green || role == Role::blue;
    if (!has(role) || (packed_ && colour)) continue;
    read_numbers(columns.column(role), first, to.size, to.values[r].data());
    if (!colour) continue;
    for (double& v : to.values[r]) v = v * colour_factor_ > 255 ? 255 : v * colour_factor_;
  }
  if (!packed_) return;
  auto& red = to.of(Role::red);
  read_numbers(columns.column(Role::packed_colour), first, to.size, red.data());
  for (std::size_t i = 0; i < to.size; ++i) {
    const auto bits = static_cast<std::uint32_t>(red[i]);
    for (unsigned c = 0; c < 3; ++c) to.of(colours[c])[i] = bits >> (16 - 8 * c) & 0xFFU;
  }
}

void ColumnSource::check_sources(std::size_t first, const std::vector<double>& sources, std::size_t count) const {
  const auto sensors = static_cast<double>(geometry_.sensors.size());
  for (std::size_t i = 0; i < count; ++i)
    if (const double v = sources[i]; !(v >= 0 && v < sensors) || v != std::floor(v))
      throw Error(fmt::format("{}: the source of point {} is sensor {}, but there are {} sensors", geometry_.path,
                              first + i, v, geometry_.sensors.size()));
}

}  // namespace atrium::io
