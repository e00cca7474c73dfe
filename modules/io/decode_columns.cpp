#include "modules/io/decode_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/parallel_blocks.hpp"

namespace atrium::io {
namespace {

constexpr std::size_t chunk = 65536;
constexpr std::size_t run = 512;
constexpr Role colour_roles[3] = {Role::red, Role::green, Role::blue};

/// Calls work(i, value) for each number of the column in [begin, end).
template <class F>
void each_number(const Column& column, std::size_t begin, std::size_t end, F&& work) {
  double v[run];
  for (std::size_t i = begin; i < end; i += run) {
    const std::size_t n = std::min(run, end - i);
    read_numbers(column, i, n, v);
    for (std::size_t k = 0; k < n; ++k) work(i + k, v[k]);
  }
}

std::uint8_t to_byte(double v) {
  if (!(v > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::min(255.0, std::floor(v + 0.5)));
}

void decode_bytes(const RawGeometry& geometry, std::vector<Colour>& colours, const Context& context) {
  context.parallel_for(
      geometry.count,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t a = 0; a < 3; ++a) {
          const Column& column = geometry.column(colour_roles[a]);
          const std::byte* from = column.data + begin * column.stride;
          for (std::size_t i = begin; i < end; ++i, from += column.stride)
            colours[i][a] = std::to_integer<std::uint8_t>(*from);
        }
      },
      chunk);
}

void decode_packed(const RawGeometry& geometry, std::vector<Colour>& colours, const Context& context) {
  context.parallel_for(
      geometry.count,
      [&](std::size_t begin, std::size_t end) {
        each_number(geometry.column(Role::packed_colour), begin, end, [&](std::size_t i, double v) {
          const auto bits = static_cast<std::uint32_t>(v);
          colours[i] = {static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 8U),
                        static_cast<std::uint8_t>(bits)};
        });
      },
      chunk);
}

/// What tells the range that colours are in.
struct ColourValues {
  double largest = 0;
  std::size_t positive = 0, fractions = 0, above_one = 0, above_byte = 0;  ///< fractions: between 0 and 1
  std::size_t uneven = 0;                                                  ///< no whole numbers
  std::size_t lacking = 0, below = 0;                                      ///< not finite; negative

  void add(double v) {
    lacking += std::isfinite(v) ? 0 : 1;
    below += v < 0 ? 1 : 0;
    if (!(v > 0) || !std::isfinite(v)) return;
    uneven += v == std::floor(v) ? 0 : 1;
    largest = std::max(largest, v);
    ++positive;
    fractions += v < 1 ? 1 : 0;
    above_one += v > 1 ? 1 : 0;
    above_byte += v > 255 ? 1 : 0;
  }
  void add(const ColourValues& other) {
    largest = std::max(largest, other.largest);
    positive += other.positive;
    fractions += other.fractions;
    above_one += other.above_one;
    above_byte += other.above_byte;
    uneven += other.uneven;
    lacking += other.lacking;
    below += other.below;
  }
  /// Whether what lies above a range's top is but an overshoot: not beyond `most`, or one value in a hundred.
  bool is_few(std::size_t above, double most) const {
    constexpr std::size_t share = 100;
    return largest <= most || above * share <= positive;
  }
};

ColourValues colours_of_columns(const RawGeometry& geometry, const Context& context) {
  std::vector<ColourValues> some((geometry.count + chunk - 1) / chunk);
  for (const Role role : colour_roles)
    context.parallel_chunks(geometry.count, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
      each_number(geometry.column(role), begin, end, [&](std::size_t, double v) { some[c].add(v); });
    });
  ColourValues all;
  for (const auto& part : some) all.add(part);
  return all;
}

ColourValues colours_of_rows(const RawGeometry& geometry, const Context& context) {
  const RowTable& rows = *geometry.rows;
  std::vector<Role> wanted = rows.roles();
  for (Role& role : wanted)
    if (std::find(std::begin(colour_roles), std::end(colour_roles), role) == std::end(colour_roles)) role = Role::none;
  std::vector<ColourValues> some(rows.blocks());
  for_blocks(context, rows.blocks(), [&](std::size_t b) {
    constexpr std::size_t some_blocks = 64;
    if (b % some_blocks == 0) drop_pages(geometry);
    RawGeometry parsed;
    Table::attach(rows.read(b, wanted), parsed);
    for (const Role role : colour_roles)
      each_number(parsed.column(role), 0, rows.rows(b), [&](std::size_t, double v) { some[b].add(v); });
  });
  ColourValues all;
  for (const auto& part : some) all.add(part);
  return all;
}

}  // namespace

double colour_factor(const RawGeometry& geometry, const Context& context) {
  bool floating = geometry.rows != nullptr;
  for (const Role role : colour_roles) {
    const Column& column = geometry.column(role);
    floating = floating || (is_floating(column.type) && !column.whole);
  }
  const ColourValues all = geometry.rows ? colours_of_rows(geometry, context) : colours_of_columns(geometry, context);
  if (all.lacking + all.below > 0)
    context.warn(fmt::format("{}: {} of the colours' values are empty, not finite or negative: they are taken for 0",
                             geometry.path, all.lacking + all.below));
  const auto cut = [&](double top, std::size_t above) {
    if (above > 0)
      context.warn(fmt::format("{}: {} of the colours' values are above {:g}, the largest is {:g}: they are cut to it",
                               geometry.path, above, top, all.largest));
  };
  // A few values above the top, as filters and interpolation make them, do not say another range.
  constexpr double few_ones = 4;  // no picture is so dark that bytes do not exceed it
  if (floating && (all.largest <= 1.0 || (all.uneven > 0 && all.largest <= few_ones) ||
                   (all.fractions > all.above_one && all.is_few(all.above_one, 2.0)))) {
    cut(1, all.above_one);
    return 255.0;
  }
  if (all.largest <= 255.0 || all.is_few(all.above_byte, 280.0)) {
    cut(255, all.above_byte);
    return 1.0;
  }
  if (all.largest > 65535.0)
    context.warn(
        fmt::format("{}: colours up to {:g}, more than 16 bits hold: they are cut", geometry.path, all.largest));
  return 255.0 / 65535.0;
}

void read_numbers(const Column& column, std::size_t first, std::size_t count, double* to) {
  const std::byte* from = column.data + first * column.stride;
  const std::size_t stride = column.stride;
  with_scalar(column.type, [&](auto t) {
    using T = decltype(t);
    if (column.swapped) {
      for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<double>(load<T>(from + i * stride, true));
    } else {
      for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<double>(load<T>(from + i * stride));
    }
  });
}

void decode_normals(const RawGeometry& geometry, const std::vector<std::uint32_t>& ignored,
                    std::vector<Eigen::Vector3f>& normals, const Context& context) {
  if (!geometry.column(Role::nx) || !geometry.column(Role::ny) || !geometry.column(Role::nz)) return;
  normals.resize(geometry.count);
  std::vector<std::size_t> bad((geometry.count + chunk - 1) / chunk);
  context.parallel_chunks(geometry.count, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    double v[3][run];
    for (std::size_t i = begin; i < end; i += run) {
      const std::size_t n = std::min(run, end - i);
      read_numbers(geometry.column(Role::nx), i, n, v[0]);
      read_numbers(geometry.column(Role::ny), i, n, v[1]);
      read_numbers(geometry.column(Role::nz), i, n, v[2]);
      for (std::size_t k = 0; k < n; ++k) {
        const double length = std::sqrt(v[0][k] * v[0][k] + v[1][k] * v[1][k] + v[2][k] * v[2][k]);
        const bool good = length > 0 && std::isfinite(length);
        const double factor = good ? 1.0 / length : 0.0;
        bad[c] += good ? 0 : 1;
        if (good)
          normals[i + k] = Eigen::Vector3d(v[0][k] * factor, v[1][k] * factor, v[2][k] * factor).cast<float>();
        else
          normals[i + k].setZero();
      }
    }
  });
  std::size_t broken = 0;
  for (const auto b : bad) broken += b;
  for (const auto i : ignored) broken -= normals[i].isZero(0) ? 1 : 0;
  if (broken == 0) return;
  normals = {};
  context.warn(fmt::format("{}: the normals of {} are zero or not finite: the file's normals are left out",
                           geometry.path, counted(broken, "point")));
}

void decode_colours(const RawGeometry& geometry, std::vector<Colour>& colours, const Context& context) {
  const bool separate = geometry.column(Role::red) && geometry.column(Role::green) && geometry.column(Role::blue);
  if (!separate && !geometry.column(Role::packed_colour)) return;
  colours.resize(geometry.count);
  if (!separate) {
    decode_packed(geometry, colours, context);
    return;
  }
  if (std::all_of(std::begin(colour_roles), std::end(colour_roles),
                  [&](Role role) { return geometry.column(role).type == Scalar::u8; })) {
    decode_bytes(geometry, colours, context);
    return;
  }
  const double factor = colour_factor(geometry, context);
  context.parallel_for(
      geometry.count,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t a = 0; a < 3; ++a)
          each_number(geometry.column(colour_roles[a]), begin, end,
                      [&](std::size_t i, double v) { colours[i][a] = to_byte(v * factor); });
      },
      chunk);
}

void decode_intensities(const RawGeometry& geometry, std::vector<float>& intensities, const Context& context) {
  if (!geometry.column(Role::intensity)) return;
  intensities.resize(geometry.count);
  std::vector<std::size_t> lacking((geometry.count + chunk - 1) / chunk);
  context.parallel_chunks(geometry.count, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    each_number(geometry.column(Role::intensity), begin, end, [&](std::size_t i, double v) {
      constexpr double most = std::numeric_limits<float>::max();
      const bool good = std::abs(v) <= most;
      intensities[i] = good ? static_cast<float>(v) : 0.0F;
      lacking[c] += good ? 0 : 1;
    });
  });
  if (const auto all = std::accumulate(lacking.begin(), lacking.end(), std::size_t{0}); all > 0)
    context.warn(fmt::format("{}: {} empty or not finite: taken for 0", geometry.path,
                             counted(all, "intensity is", "intensities are")));
}

void decode_source(const RawGeometry& geometry, std::vector<std::uint16_t>& source, const Context& context) {
  if (!geometry.column(Role::source) || geometry.sensors.empty()) return;
  source.resize(geometry.count);
  const auto sensors = static_cast<double>(geometry.sensors.size());
  context.parallel_for(
      geometry.count,
      [&](std::size_t begin, std::size_t end) {
        each_number(geometry.column(Role::source), begin, end, [&](std::size_t i, double v) {
          if (!(v >= 0 && v < sensors) || v != std::floor(v))
            throw Error(fmt::format("{}: the source of point {} is sensor {}, but there are {} sensors", geometry.path,
                                    i, v, geometry.sensors.size()));
          source[i] = static_cast<std::uint16_t>(v);
        });
      },
      chunk);
}

void decode_labels(const RawGeometry& geometry, std::vector<std::int32_t>& labels, const Context& context) {
  if (!geometry.column(Role::label)) return;
  labels.resize(geometry.count);
  std::vector<std::size_t> odd((geometry.count + chunk - 1) / chunk);
  context.parallel_chunks(geometry.count, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    each_number(geometry.column(Role::label), begin, end, [&](std::size_t i, double v) {
      constexpr double low = std::numeric_limits<std::int32_t>::min();
      constexpr double high = std::numeric_limits<std::int32_t>::max();
      const double label = std::isnan(v) ? -1 : std::clamp(std::round(v), low, high);
      labels[i] = static_cast<std::int32_t>(label);
      odd[c] += label == v || std::isnan(v) ? 0 : 1;
    });
  });
  if (const auto all = std::accumulate(odd.begin(), odd.end(), std::size_t{0}); all > 0)
    context.warn(fmt::format("{}: {} of 32 bits: rounded", geometry.path,
                             counted(all, "label is no whole number", "labels are no whole numbers")));
}

}  // namespace atrium::io
