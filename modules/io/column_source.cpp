#include "modules/io/column_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/io/decode_columns.hpp"

namespace atrium::io {

ColumnSource::ColumnSource(const RawGeometry& geometry, const Context& context) : geometry_(geometry) {
  const auto provide_all = [&](std::initializer_list<Role> roles) {
    const bool all = std::all_of(roles.begin(), roles.end(), [&](Role r) { return bool(geometry.column(r)); });
    for (const Role role : roles)
      if (all) provide(role);
    return all;
  };
  provide_all({Role::x, Role::y, Role::z});
  provide_all({Role::nx, Role::ny, Role::nz});
  provide_all({Role::intensity});
  provide_all({Role::label});
  if (!geometry.sensors.empty()) provide_all({Role::source});
  if (provide_all({Role::red, Role::green, Role::blue})) {
    const bool bytes = geometry.column(Role::red).type == Scalar::u8 &&
                       geometry.column(Role::green).type == Scalar::u8 &&
                       geometry.column(Role::blue).type == Scalar::u8;
    colour_factor_ = bytes ? 1.0 : colour_factor(geometry, context);
  } else if (geometry.column(Role::packed_colour)) {
    packed_ = true;
    for (const Role role : {Role::red, Role::green, Role::blue}) provide(role);
  }
}

std::size_t ColumnSource::capacity(std::size_t block) const {
  return std::min(block_size, geometry_.count - block * block_size);
}

void ColumnSource::read(std::size_t block, PointBlock& to) const {
  const std::size_t first = block * block_size, count = capacity(block);
  to.resize(count, roles());
  to.misses = 0;
  constexpr Role colours[3] = {Role::red, Role::green, Role::blue};
  for (std::size_t r = 0; r < role_count; ++r) {
    const auto role = static_cast<Role>(r);
    const bool colour = role == Role::red || role == Role::green || role == Role::blue;
    if (!has(role) || (packed_ && colour)) continue;
    read_numbers(geometry_.column(role), first, count, to.values[r].data());
    if (!colour) continue;
    for (double& v : to.values[r]) v = v * colour_factor_ > 255 ? 255 : v * colour_factor_;
  }
  if (packed_) {
    auto& red = to.of(Role::red);
    read_numbers(geometry_.column(Role::packed_colour), first, count, red.data());
    for (std::size_t i = 0; i < count; ++i) {
      const auto bits = static_cast<std::uint32_t>(red[i]);
      for (unsigned c = 0; c < 3; ++c) to.of(colours[c])[i] = bits >> (16 - 8 * c) & 0xFFU;
    }
  }
  if (!has(Role::source)) return;
  const auto sensors = static_cast<double>(geometry_.sensors.size());
  for (std::size_t i = 0; i < count; ++i)
    if (const double v = to.of(Role::source)[i]; !(v >= 0 && v < sensors) || v != std::floor(v))
      throw Error(fmt::format("{}: the source of point {} is sensor {}, but there are {} sensors", geometry_.path,
                              first + i, v, geometry_.sensors.size()));
}

}  // namespace atrium::io
