#include "modules/io/decode_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/decode.hpp"

namespace atrium::io {
namespace {

bool within_reach(double v) { return std::abs(v) <= largest_coordinate; }  // false for NaN

std::uint8_t colour_byte(double v) {
  if (!(v > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::min(255.0, std::floor(v + 0.5)));
}

std::int32_t label_number(double v) {
  constexpr double low = std::numeric_limits<std::int32_t>::min(), high = std::numeric_limits<std::int32_t>::max();
  return std::isnan(v) ? -1 : static_cast<std::int32_t>(std::clamp(std::round(v), low, high));
}

float intensity_of(double v) {
  constexpr double most = std::numeric_limits<float>::max();
  return std::abs(v) <= most ? static_cast<float>(v) : 0.0F;
}

/// Calls take(i) for the points that were kept.
template <class T, class F>
void fill(std::vector<T>& column, const std::vector<std::uint32_t>& kept, F&& take) {
  column.resize(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) column[i] = take(kept[i]);
}

/// The other columns of the points `kept` of a block.
void fill_columns(const PointBlock& block, const std::array<bool, role_count>& roles,
                  const std::vector<std::uint32_t>& kept, LocalBlock& to) {
  const auto has = [&](Role role) { return roles[static_cast<std::size_t>(role)]; };
  if (has(Role::nx))
    fill(to.points.normals, kept, [&](std::size_t i) {
      const Eigen::Vector3d n(block.of(Role::nx)[i], block.of(Role::ny)[i], block.of(Role::nz)[i]);
      const double length = n.norm();
      const bool good = length > 0 && std::isfinite(length);
      to.bad_normals += good ? 0 : 1;
      return good ? Eigen::Vector3f((n / length).cast<float>()) : Eigen::Vector3f(Eigen::Vector3f::Zero());
    });
  if (has(Role::red)) {
    const auto &r = block.of(Role::red), &g = block.of(Role::green), &b = block.of(Role::blue);
    fill(to.points.colours, kept, [&](std::size_t i) {
      return Colour{colour_byte(r[i]), colour_byte(g[i]), colour_byte(b[i])};
    });
  }
  if (has(Role::intensity))
    fill(to.points.intensities, kept, [&](std::size_t i) { return intensity_of(block.of(Role::intensity)[i]); });
  if (has(Role::label))
    fill(to.points.labels, kept, [&](std::size_t i) { return label_number(block.of(Role::label)[i]); });
  if (has(Role::source))
    fill(to.points.source, kept, [&](std::size_t i) { return static_cast<std::uint16_t>(block.of(Role::source)[i]); });
}

/// Calls f(column of a, column of b) for each column of two clouds.
template <class F>
void for_columns(Cloud& a, Cloud& b, F&& f) {
  f(a.points, b.points);
  f(a.normals, b.normals);
  f(a.colours, b.colours);
  f(a.labels, b.labels);
  f(a.intensities, b.intensities);
  f(a.source, b.source);
}

/// The cloud's columns for the points of all blocks: block b's begin at places[b].
Cloud with_room(const PointSource& source, std::size_t points) {
  Cloud cloud;
  cloud.points.resize(points);
  const auto room = [&](Role role) { return source.has(role) ? points : 0; };
  cloud.normals.resize(room(Role::nx));
  cloud.colours.resize(room(Role::red));
  cloud.intensities.resize(room(Role::intensity));
  cloud.labels.resize(room(Role::label));
  cloud.source.resize(room(Role::source));
  return cloud;
}

/// Moves the blocks' points together.
void close_gaps(const std::vector<std::size_t>& places, const std::vector<std::size_t>& kept, Cloud& cloud) {
  std::size_t total = 0;
  for (const auto k : kept) total += k;
  for_columns(cloud, cloud, [&](auto& column, auto&) {
    if (column.empty()) return;
    auto to = column.begin();
    for (std::size_t b = 0; b < kept.size(); ++b) {
      const auto from = column.begin() + static_cast<std::ptrdiff_t>(places[b]);
      to = from == to ? from + static_cast<std::ptrdiff_t>(kept[b]) : std::copy_n(from, kept[b], to);
    }
    column.resize(total);
    if (total < column.capacity() / 4 * 3) column.shrink_to_fit();
  });
}

}  // namespace

void localise(const PointBlock& block, const std::array<bool, role_count>& roles, double scale,
              const Eigen::Vector3d& origin, LocalBlock& to) {
  std::vector<std::uint32_t> kept;
  kept.reserve(block.size);
  const auto &x = block.of(Role::x), &y = block.of(Role::y), &z = block.of(Role::z);
  to.points.points.clear();
  to.points.points.reserve(block.size);
  for (std::size_t i = 0; i < block.size; ++i) {
    const double a = x[i] * scale, b = y[i] * scale, c = z[i] * scale;
    if (!within_reach(a) || !within_reach(b) || !within_reach(c)) continue;
    to.points.points.emplace_back(static_cast<float>(a - origin.x()), static_cast<float>(b - origin.y()),
                                  static_cast<float>(c - origin.z()));
    kept.push_back(static_cast<std::uint32_t>(i));
  }
  to.misses = block.misses;
  to.not_finite = block.size - kept.size();
  to.bad_normals = 0;
  fill_columns(block, roles, kept, to);
}

void for_blocks(const PointSource& source, double scale, const Eigen::Vector3d& origin, const Context& context,
                const std::function<void(std::size_t, LocalBlock&)>& work) {
  constexpr std::size_t some_blocks = 4;  // share their buffers
  std::atomic<std::size_t> done = 0;
  const std::size_t count = source.blocks();
  context.parallel_chunks(count, source.capacity(0) > 20000 ? 1 : some_blocks,
                          [&](std::size_t, std::size_t begin, std::size_t end) {
                            PointBlock block;
                            LocalBlock local;
                            for (std::size_t b = begin; b < end; ++b) {
                              source.read(b, block);
                              localise(block, source.roles(), scale, origin, local);
                              work(b, local);
                            }
                            const std::size_t so_far = done.fetch_add(end - begin) + (end - begin);
                            context.progress(static_cast<double>(so_far) / static_cast<double>(count));
                          });
}

std::vector<Eigen::Vector3d> some_points(const PointSource& source, double scale) {
  constexpr std::size_t of_block = 101;
  std::vector<Eigen::Vector3d> points;
  const std::size_t blocks = source.blocks(), wanted = std::min(source.samples(), blocks);
  PointBlock block;
  const auto take = [&](std::size_t b) {
    source.read(b, block);
    const std::size_t step = std::max<std::size_t>(1, block.size / of_block);
    for (std::size_t i = 0; i < block.size; i += step) {
      const Eigen::Vector3d p =
          scale * Eigen::Vector3d(block.of(Role::x)[i], block.of(Role::y)[i], block.of(Role::z)[i]);
      if (within_reach(p.x()) && within_reach(p.y()) && within_reach(p.z())) points.push_back(p);
    }
  };
  for (std::size_t k = 0; k < wanted; ++k) take(k * blocks / wanted);
  for (std::size_t b = 0; points.empty() && b < blocks; ++b) take(b);
  return points;
}

Cloud decode_blocks(const RawGeometry& geometry, double scale, const Context& context) {
  const PointSource& source = *geometry.source;
  const Eigen::Vector3d origin = choose_origin(geometry, scale);
  std::vector<std::size_t> places(source.blocks()), kept(source.blocks());
  std::size_t room = 0;
  for (std::size_t b = 0; b < source.blocks(); ++b) {
    places[b] = room;
    room += source.capacity(b);
  }
  Cloud cloud = with_room(source, room);
  cloud.origin = origin;
  std::atomic<std::size_t> not_finite = 0, bad_normals = 0, misses = 0;
  for_blocks(source, scale, origin, context, [&](std::size_t b, LocalBlock& local) {
    constexpr std::size_t some_blocks = 64;
    if (b % some_blocks == 0) drop_pages(geometry);  // no block is read twice
    kept[b] = local.points.size();
    not_finite += local.not_finite;
    bad_normals += local.bad_normals;
    misses += local.misses;
    for_columns(local.points, cloud, [&](auto& from, auto& to) {
      if (!to.empty()) std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(places[b]));
    });
  });
  close_gaps(places, kept, cloud);
  finish_blocks(geometry, {cloud.size(), not_finite, misses, bad_normals}, scale, cloud, context);
  return cloud;
}

void finish_blocks(const RawGeometry& geometry, const RecordCounts& counts, double scale, Cloud& cloud,
                   const Context& context) {
  const std::size_t read = counts.points + counts.not_finite + counts.misses;
  if (counts.misses > 0)
    context.info(fmt::format("{}: {} of {} records are no points: nothing was hit, or they are withheld", geometry.path,
                             counts.misses, geometry.count));
  if (counts.points < 3)
    throw Error(
        fmt::format("{}: only {} of {} records are points with finite coordinates", geometry.path, cloud.size(), read),
        "three points are the least that define a plane");
  if (counts.not_finite > 0)
    context.warn(fmt::format("{}: {} of {} points dropped: coordinates not finite, or beyond 10⁹ m", geometry.path,
                             counts.not_finite, read - counts.misses));
  if (counts.bad_normals > 0) {
    cloud.normals = {};
    context.warn(fmt::format("{}: the normals of {} are zero or not finite: the file's normals are left out",
                             geometry.path, counted(counts.bad_normals, "point")));
  }
  for (const auto& sensor : geometry.sensors) cloud.sensors.emplace_back((sensor * scale - cloud.origin).cast<float>());
  if (cloud.sensors.size() < 2) cloud.source = {};
}

}  // namespace atrium::io
