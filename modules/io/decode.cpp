#include "modules/io/decode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/io/decode_columns.hpp"
#include "modules/io/decode_source.hpp"

namespace atrium::io {
namespace {

constexpr Role axes[3] = {Role::x, Role::y, Role::z};

/// Numbers that are no class of ours become `object`.
SurfaceClass class_of(std::int32_t number) {
  return number >= 0 && number <= 3 ? static_cast<SurfaceClass>(number) : SurfaceClass::object;
}

bool is_good(double v) { return std::abs(v) <= largest_coordinate; }  // false for NaN

/// Runs of the columns x, y, z as doubles: scaled, without the origin.
class Positions {
 public:
  Positions(const RawGeometry& geometry, double scale, const Eigen::Vector3d& origin)
      : geometry_(geometry), scale_(scale), origin_(origin) {}

  /// Calls store(index, x, y, z) for the good points of [begin, end) and bad(index) for the others.
  template <class Store, class Bad>
  void read(std::size_t begin, std::size_t end, Store&& store, Bad&& bad) const {
    constexpr std::size_t run = 512;
    double v[3][run];
    for (std::size_t i = begin; i < end; i += run) {
      const std::size_t n = std::min(run, end - i);
      for (int a = 0; a < 3; ++a) {
        read_numbers(geometry_.column(axes[a]), i, n, v[a]);
        for (std::size_t k = 0; k < n; ++k) v[a][k] *= scale_;
      }
      for (std::size_t k = 0; k < n; ++k) {
        if (is_good(v[0][k]) && is_good(v[1][k]) && is_good(v[2][k]))
          store(i + k, v[0][k] - origin_.x(), v[1][k] - origin_.y(), v[2][k] - origin_.z());
        else
          bad(i + k);
      }
    }
  }

 private:
  const RawGeometry& geometry_;
  double scale_;
  Eigen::Vector3d origin_;
};

/// Indices of the points without finite coordinates, ascending; fills `points`, zero at those.
std::vector<std::uint32_t> decode_points(const RawGeometry& geometry, double scale, Cloud& cloud,
                                         const Context& context) {
  constexpr std::size_t chunk = 65536;
  cloud.points.resize(geometry.count);
  const Positions positions(geometry, scale, cloud.origin);
  std::vector<std::vector<std::uint32_t>> bad((geometry.count + chunk - 1) / chunk);
  context.parallel_chunks(geometry.count, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    positions.read(
        begin, end,
        [&](std::size_t i, double x, double y, double z) { cloud.points[i] = Eigen::Vector3d(x, y, z).cast<float>(); },
        [&](std::size_t i) {
          cloud.points[i].setZero();
          bad[c].push_back(static_cast<std::uint32_t>(i));
        });
  });
  std::vector<std::uint32_t> all;
  for (const auto& some : bad) all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// 0 … count-1 without those dropped.
std::vector<std::uint32_t> others(std::size_t count, const std::vector<std::uint32_t>& dropped) {
  std::vector<std::uint32_t> kept;
  kept.reserve(count - dropped.size());
  auto next = dropped.begin();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (next != dropped.end() && *next == i)
      ++next;
    else
      kept.push_back(i);
  }
  return kept;
}

Eigen::Vector3d scaled(Eigen::Vector3d p, double scale, bool& good) {
  p *= scale;
  good = is_good(p.x()) && is_good(p.y()) && is_good(p.z());
  return p;
}

Eigen::Vector3d position_in(const std::vector<Role>& roles, const double* numbers, double scale, bool& good) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < roles.size(); ++c)
    for (int a = 0; a < 3; ++a)
      if (roles[c] == axes[a]) p[a] = numbers[c];
  return scaled(p, scale, good);
}

Eigen::Vector3d good_position(const RawGeometry& geometry, double scale, std::size_t i, bool& good) {
  if (geometry.rows) {
    std::vector<double> numbers(geometry.rows->roles().size());
    geometry.rows->read_row(i, numbers.data());
    return position_in(geometry.rows->roles(), numbers.data(), scale, good);
  }
  Eigen::Vector3d p;
  for (int a = 0; a < 3; ++a) read_numbers(geometry.column(axes[a]), i, 1, &p[a]);
  return scaled(p, scale, good);
}

/// The good positions of the first block of rows that has any, or the first good one of columns: at most one pass.
std::vector<Eigen::Vector3d> first_good_positions(const RawGeometry& geometry, double scale) {
  std::vector<Eigen::Vector3d> result;
  if (!geometry.rows) {
    for (std::size_t i = 0; result.empty() && i < geometry.count; ++i) {
      bool good = false;
      const Eigen::Vector3d p = good_position(geometry, scale, i, good);
      if (good) result.push_back(p);
    }
    return result;
  }
  const RowTable& rows = *geometry.rows;
  for (std::size_t b = 0; result.empty() && b < rows.blocks(); ++b) {
    const auto table = rows.read(b, rows.roles());
    for (std::size_t i = 0; i < rows.rows(b); ++i) {
      bool good = false;
      const Eigen::Vector3d p = position_in(rows.roles(), table->row(i), scale, good);
      if (good) result.push_back(p);
    }
    drop_pages(geometry);
  }
  return result;
}

}  // namespace

void check_count(const RawGeometry& geometry) {
  if (geometry.count > std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("{}: {} points; the most that can be handled are {}", geometry.path, geometry.count,
                            std::numeric_limits<std::uint32_t>::max()));
  if (geometry.count < 3)
    throw Error(fmt::format("{}: {}", geometry.path,
                            geometry.count == 0   ? "no points"
                            : geometry.count == 1 ? "only 1 point"
                                                  : "only 2 points"),
                "three points are the least that define a plane");
}

Eigen::Vector3d choose_origin(const RawGeometry& geometry, double scale) {
  constexpr std::size_t wanted = 2001;
  std::vector<double> sample[3];
  const auto take = [&](std::size_t i) {
    bool good = false;
    const Eigen::Vector3d p = good_position(geometry, scale, i, good);
    if (!good) return false;
    for (int a = 0; a < 3; ++a) sample[a].push_back(p[a]);
    return true;
  };
  if (geometry.source) {
    for (const auto& p : some_points(*geometry.source, scale))
      for (int a = 0; a < 3; ++a) sample[a].push_back(p[a]);
  } else {
    const std::size_t step = std::max<std::size_t>(1, geometry.count / wanted);
    constexpr std::size_t some_takes = 64;  // of rows, each may be in another part of the file
    for (std::size_t i = 0; i < geometry.count; i += step) {
      take(i);
      if (geometry.rows && i / step % some_takes == 0) drop_pages(geometry);
    }
    if (sample[0].empty()) {
      for (const auto& p : first_good_positions(geometry, scale))
        for (int a = 0; a < 3; ++a) sample[a].push_back(p[a]);
    }
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (sample[0].empty()) return origin;
  for (int a = 0; a < 3; ++a) {
    const double middle = median(std::move(sample[a]));
    if (std::abs(middle) > largest_local_coordinate) origin[a] = std::floor(middle);
  }
  return origin;
}

bool has_float_positions(const RawGeometry& geometry) {
  return geometry.float_table || (!geometry.source && geometry.column(Role::x).type == Scalar::f32);
}

void warn_of_lost_digits(const RawGeometry& geometry, const Eigen::Vector3d& origin, double scale,
                         const Context& context) {
  constexpr double fine = 0.001;  // metres
  if (!has_float_positions(geometry)) return;
  double worst = 0;
  int axis = 0;
  for (int a = 0; a < 3; ++a) {  // float32 has 24 bits: far from zero the coordinates move in steps
    const auto there = static_cast<float>(std::abs(origin[a]) / scale);
    const double step = (std::nextafter(there, std::numeric_limits<float>::max()) - there) * scale;
    if (step <= worst) continue;
    worst = step;
    axis = a;
  }
  if (worst > fine)
    context.warn(
        fmt::format("{}: coordinates along {} are in steps of {:.2g} m, as float32 is so far from zero: what was finer "
                    "is lost; export as double, or shifted",
                    geometry.path, "xyz"[axis], worst));
}

Cloud decode_cloud(const RawGeometry& geometry, double scale, const Context& context,
                   std::vector<std::uint32_t>* kept) {
  check_count(geometry);
  if (geometry.source) return decode_blocks(geometry, scale, context);
  Cloud cloud;
  cloud.origin = choose_origin(geometry, scale);
  const std::vector<std::uint32_t> dropped = decode_points(geometry, scale, cloud, context);
  decode_normals(geometry, dropped, cloud.normals, context);
  decode_colours(geometry, cloud.colours, context);
  decode_intensities(geometry, cloud.intensities, context);
  decode_labels(geometry, cloud.labels, context);
  decode_source(geometry, cloud.source, context);
  for (const auto& sensor : geometry.sensors) cloud.sensors.emplace_back((sensor * scale - cloud.origin).cast<float>());
  if (kept != nullptr) *kept = others(cloud.size(), dropped);
  if (dropped.empty()) return cloud;
  const std::size_t left = cloud.size() - dropped.size();
  if (left == 0)
    throw Error(fmt::format("{}: none of the {} points has finite coordinates", geometry.path, cloud.size()));
  if (left < 3)
    throw Error(fmt::format("{}: only {} of {} points have finite coordinates", geometry.path, left, cloud.size()),
                "three points are the least that define a plane");
  context.warn(fmt::format("{}: {} of {} points dropped: coordinates not finite, or beyond 10⁹ m", geometry.path,
                           dropped.size(), cloud.size()));
  return select(cloud, others(cloud.size(), dropped));
}

Mesh decode_mesh(const RawGeometry& geometry, double scale, const Context& context) {
  if (geometry.source)
    throw Error(geometry.path + ": a file of points, without faces", "io.read_scan reads it as a cloud");
  Mesh mesh;
  mesh.origin = choose_origin(geometry, scale);
  mesh.vertices.resize(geometry.count, Eigen::Vector3d::Zero());
  std::vector<std::uint8_t> good(geometry.count, 1);
  const Positions positions(geometry, scale, mesh.origin);
  context.parallel_for(geometry.count, [&](std::size_t begin, std::size_t end) {
    positions.read(
        begin, end,
        [&](std::size_t i, double x, double y, double z) {
          mesh.vertices[i] = {x, y, z};
        },
        [&](std::size_t i) { good[i] = 0; });
  });
  decode_colours(geometry, mesh.colours, context);
  std::vector<std::array<std::uint32_t, 3>> triangles = geometry.triangles;
  cut_concave_faces(mesh.vertices, geometry.fans, triangles);

  // Bad vertices go, and the triangles on them.
  std::vector<std::uint32_t> place(geometry.count);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < geometry.count; ++i) {
    place[i] = kept;
    if (good[i] == 0) continue;
    mesh.vertices[kept] = mesh.vertices[i];
    if (!mesh.colours.empty()) mesh.colours[kept] = mesh.colours[i];
    ++kept;
  }
  mesh.vertices.resize(kept);
  if (!mesh.colours.empty()) mesh.colours.resize(kept);
  mesh.triangles.reserve(geometry.triangles.size());
  for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (good[a] == 0 || good[b] == 0 || good[c] == 0) continue;
    mesh.triangles.push_back({place[a], place[b], place[c]});
    if (!geometry.classes.empty()) mesh.classes.push_back(class_of(geometry.classes[t]));
    if (!geometry.storeys.empty()) mesh.storeys.push_back(geometry.storeys[t]);
    if (!geometry.primitives.empty()) mesh.primitives.push_back(geometry.primitives[t]);
  }
  if (kept < geometry.count)
    context.warn(
        fmt::format("{}: {} of {} vertices and {} of {} triangles dropped: coordinates not finite, or beyond 10⁹ m",
                    geometry.path, geometry.count - kept, geometry.count,
                    geometry.triangles.size() - mesh.triangles.size(), geometry.triangles.size()));
  return mesh;
}

Bounds3 bounds_of(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  if (points.empty()) return {};
  constexpr std::size_t chunk = 262144;
  std::vector<Bounds3> some((points.size() + chunk - 1) / chunk);
  context.parallel_chunks(points.size(), chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    Bounds3 b{points[begin], points[begin]};
    for (std::size_t i = begin; i < end; ++i) {
      b.low = b.low.cwiseMin(points[i]);
      b.high = b.high.cwiseMax(points[i]);
    }
    some[c] = b;
  });
  Bounds3 all = some.front();
  for (const auto& b : some) {
    all.low = all.low.cwiseMin(b.low);
    all.high = all.high.cwiseMax(b.high);
  }
  return all;
}

}  // namespace atrium::io
