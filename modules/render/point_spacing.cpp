#include "modules/render/point_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "modules/geometry/quantile.hpp"

namespace atrium::render {
namespace {

/// The cubes of this size that hold points, and how many they hold.
struct Cubes {
  Eigen::Vector3f corner;
  float size;
  std::vector<std::uint64_t> keys;  ///< ascending
  std::vector<std::uint32_t> counts;

  std::uint64_t key(const Eigen::Vector3f& point) const {
    const Eigen::Vector3f place = (point - corner) / size;
    const auto along = [&](int axis) { return static_cast<std::uint64_t>(place[axis]) & 0x1fffffU; };
    return along(0) << 42U | along(1) << 21U | along(2);
  }
  void fill(const std::vector<Eigen::Vector3f>& points, std::size_t step) {
    std::vector<std::uint64_t> all;
    all.reserve(points.size() / step + 1);
    for (std::size_t i = 0; i < points.size(); i += step) all.push_back(key(points[i]));
    std::sort(all.begin(), all.end());
    keys.clear();
    counts.clear();
    for (const std::uint64_t k : all) {
      if (keys.empty() || keys.back() != k) {
        keys.push_back(k);
        counts.push_back(0);
      }
      ++counts.back();
    }
  }
};

}  // namespace

PointSpacing point_spacing(const std::vector<Eigen::Vector3f>& points) {
  constexpr std::size_t most_for_size = 200000;
  constexpr std::size_t wanted = 9;  // points in a cube on average: enough to show the density of a surface
  PointSpacing result;
  result.lone.assign(points.size(), 0);
  if (points.empty()) return result;
  Eigen::Vector3f low = points.front();
  Eigen::Vector3f high = low;
  for (const auto& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const float diagonal = (high - low).norm();
  if (diagonal <= 0) return result;
  // Some of the points tell the size of the cubes; all of them are counted then.
  const std::size_t step = points.size() / most_for_size + 1;
  Cubes cubes{low, std::max(diagonal / 2000, 1e-3F), {}, {}};
  for (; cubes.size < diagonal; cubes.size *= 1.5F) {
    cubes.fill(points, step);
    if (points.size() >= wanted * cubes.keys.size()) break;
  }
  cubes.fill(points, 1);
  const std::uint32_t usual = median(cubes.counts);
  result.spacing = cubes.size / std::sqrt(static_cast<double>(usual));
  const std::uint32_t few = usual / 4;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cube = std::lower_bound(cubes.keys.begin(), cubes.keys.end(), cubes.key(points[i]));
    result.lone[i] = cubes.counts[static_cast<std::size_t>(cube - cubes.keys.begin())] <= few ? 1 : 0;
  }
  return result;
}

}  // namespace atrium::render
