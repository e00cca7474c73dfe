#include "modules/layout/ceilings_behind.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/layout/coverage.hpp"

namespace atrium::layout {
namespace {

constexpr double least_begin = 0.02, strip_end = 0.065;  // metres from the plane: walls are thicker
constexpr double least_strip = 0.02;                     // metres wide: with much noise nothing can be told
constexpr double least_gap = 0.04, most_gap = 0.5;       // metres between the column's end and the ceiling
constexpr double one_ceiling = 0.03;                     // metres
constexpr double around_top = 0.15;                      // metres, to each side
constexpr double around_column = 0.25;                   // metres, to each side
constexpr double unseen = std::numeric_limits<double>::lowest();

/// Where points are sparse, a column's highest one lies below the surface's end.
std::vector<double> highest_around(const std::vector<double>& tops, int reach) {
  std::vector<double> result(tops);
  const auto n = static_cast<std::int64_t>(tops.size());
  for (std::int64_t c = 0; c < n; ++c)
    for (std::int64_t k = std::max<std::int64_t>(0, c - reach); k <= std::min(n - 1, c + reach); ++k)
      result[static_cast<std::size_t>(c)] =
          std::max(result[static_cast<std::size_t>(c)], tops[static_cast<std::size_t>(k)]);
  return result;
}

/// The heights of the ceiling over the strips on the two sides of a column; `unseen` where none was seen.
struct ColumnStrips {
  double before = unseen, behind = unseen;
};

std::vector<double> shares_of(const std::vector<ColumnStrips>& strips, double same, int window) {
  const auto n = static_cast<std::int64_t>(strips.size());
  std::vector<double> result(strips.size(), 0);
  for (std::int64_t c = 0; c < n; ++c) {
    int before = 0, both = 0;
    for (std::int64_t k = std::max<std::int64_t>(0, c - window); k <= std::min(n - 1, c + window); ++k) {
      const ColumnStrips& strip = strips[static_cast<std::size_t>(k)];
      before += strip.before != unseen ? 1 : 0;
      both +=
          strip.behind != unseen && (strip.before == unseen || std::abs(strip.before - strip.behind) < same) ? 1 : 0;
    }
    if (before > 1) result[static_cast<std::size_t>(c)] = std::min(1.0, static_cast<double>(both) / before);
  }
  return result;
}

}  // namespace

CeilingsBehind::CeilingsBehind(const PlanePrimitives& planes) : noise_(mean_residual(planes)) {
  for (const auto& primitive : planes.primitives) {
    if (!is_level(primitive.plane) || primitive.plane.normal.z() > 0) continue;
    for (const auto i : primitive.inliers) {
      const Eigen::Vector3f& p = planes.cloud->points[i];
      points_.push_back({key_of(static_cast<std::int64_t>(std::floor(p.x() / edge)),
                                static_cast<std::int64_t>(std::floor(p.y() / edge))),
                         p});
    }
  }
  std::stable_sort(points_.begin(), points_.end(), [](const Square& a, const Square& b) { return a.key < b.key; });
}

template <class Work>
void CeilingsBehind::each_near(const Plane& plane, const Eigen::Vector2d& along, const Eigen::Vector2d& ends,
                               double height, const Work& work) const {
  const Eigen::Vector2d normal = plane.normal.head<2>().normalized();
  const Eigen::Vector2d foot = -normal * plane.signed_distance({0, 0, 0});
  // Where the plane is at that height: walls lean by a little.
  const Eigen::Vector2d line = foot - normal * (plane.normal.z() * height / plane.normal.head<2>().norm());
  const double reach = strip_end + 0.1;
  Eigen::AlignedBox2d box;
  for (const double at : ends)
    for (const double off : {-reach, reach}) box.extend((line + along * (at - along.dot(line)) + normal * off).eval());
  const auto first = (box.min() / edge).array().floor().cast<std::int64_t>().eval();
  const auto last = (box.max() / edge).array().floor().cast<std::int64_t>().eval();
  for (std::int64_t y = first.y(); y <= last.y(); ++y)
    for (std::int64_t x = first.x(); x <= last.x(); ++x) {
      const Eigen::Vector2d centre((static_cast<double>(x) + 0.5) * edge, (static_cast<double>(y) + 0.5) * edge);
      if (std::abs(normal.dot(centre - line)) > reach + edge) continue;
      const std::int64_t key = key_of(x, y);
      for (auto it = std::lower_bound(points_.begin(), points_.end(), key,
                                      [](const Square&s, std::int64_t k) { return s.key < k; });
           it != points_.end() && it->key == key; ++it)
        work(it->point.template cast<double>());
    }
}

std::vector<double> CeilingsBehind::shares(const Plane& plane, const Eigen::Vector2d& along, double from, double width,
                                           const std::vector<double>& seen_tops) const {
  std::vector<double> result(seen_tops.size(), 0);
  if (points_.empty() || seen_tops.empty()) return result;
  const std::vector<double> tops = highest_around(seen_tops, static_cast<int>(std::lround(around_top / width)));
  const double begin = std::max(least_begin, 3 * noise_), gap = std::max(least_gap, 3 * noise_);
  if (strip_end - begin < least_strip) return result;
  const double same = std::max(one_ceiling, 3 * noise_);
  std::vector<ColumnStrips> strips(tops.size());
  const auto add = [&](const Eigen::Vector3d& p) {
    const auto column = static_cast<std::int64_t>(std::floor((along.dot(p.head<2>()) - from) / width));
    if (column < 0 || column >= static_cast<std::int64_t>(tops.size())) return;
    const auto c = static_cast<std::size_t>(column);
    const double distance = plane.signed_distance(p), off = std::abs(distance);
    if (off < begin || off > strip_end || tops[c] == unseen || p.z() < tops[c] + gap || p.z() > tops[c] + most_gap)
      return;
    double& z = distance > 0 ? strips[c].before : strips[c].behind;
    if (z == unseen || p.z() < z) z = p.z();  // the lowest one over the column's end
  };
  const double high = *std::max_element(tops.begin(), tops.end());
  if (high == unseen) return result;
  each_near(plane, along, {from, from + width * static_cast<double>(tops.size())}, high, add);
  return shares_of(strips, same, std::max(1, static_cast<int>(std::lround(around_column / width))));
}

void find_open_tops(const PlanePrimitives& planes, std::vector<Footprint>& footprints, const Context& context) {
  const CeilingsBehind ceilings(planes);
  context.parallel_for(
      footprints.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          Footprint& wall = footprints[i];
          if (!wall.upright) continue;
          wall.open_top = ceilings.shares(planes.primitives[i].plane, wall.along, wall.raster.low.x(),
                                          wall.raster.pixel, wall.tops);
        }
      },
      1);
}

}  // namespace atrium::layout
