#include "modules/io/duplicates.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <set>

#include "graph/api/random.hpp"

namespace atrium::io {
namespace {

std::uint64_t hash_of(const Eigen::Vector3f& p) {
  // +0: so that -0 and 0 are the same place.
  const std::uint64_t x = std::bit_cast<std::uint32_t>(p.x() + 0.0F);
  const std::uint64_t y = std::bit_cast<std::uint32_t>(p.y() + 0.0F);
  const std::uint64_t z = std::bit_cast<std::uint32_t>(p.z() + 0.0F);
  return mix_seed(x << 32U | y, z);
}

using Place = std::array<float, 3>;

Place place_of(const Eigen::Vector3f& p) { return {p.x() + 0.0F, p.y() + 0.0F, p.z() + 0.0F}; }

/// How many places there are, if they are fewer than `limit`; else some number from there on.
std::size_t count_places(const std::vector<Eigen::Vector3f>& points, std::size_t step, std::size_t limit) {
  std::set<Place> places;
  for (std::size_t i = 0; i < points.size() && places.size() < limit; i += step) places.insert(place_of(points[i]));
  return places.size();
}

}  // namespace

std::size_t few_places(const std::vector<Eigen::Vector3f>& points) {
  constexpr std::size_t least = 4, looked_at = 2000, most = 1000;
  if (points.size() < least) return 0;
  const std::size_t few = std::clamp<std::size_t>(points.size() / 10, 2, most);
  if (count_places(points, std::max<std::size_t>(1, points.size() / looked_at), few) == few) return 0;
  const std::size_t places = count_places(points, 1, few);
  return places < few ? places : 0;
}

double duplicate_share(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  constexpr std::size_t places = 16384;
  constexpr std::size_t chunk = 65536;
  const std::uint64_t one_in = std::max<std::size_t>(1, points.size() / places);
  std::vector<std::vector<std::uint64_t>> some((points.size() + chunk - 1) / chunk);
  context.parallel_chunks(points.size(), chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (const std::uint64_t h = hash_of(points[i]); h % one_in == 0) some[c].push_back(h);
  });
  std::vector<std::uint64_t> hashes;
  for (const auto& part : some) hashes.insert(hashes.end(), part.begin(), part.end());
  if (hashes.empty()) return 0;
  std::sort(hashes.begin(), hashes.end());
  const auto distinct = std::unique(hashes.begin(), hashes.end()) - hashes.begin();
  return 1.0 - static_cast<double>(distinct) / static_cast<double>(hashes.size());
}

}  // namespace atrium::io
