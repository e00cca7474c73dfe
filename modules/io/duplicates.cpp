#include "modules/io/duplicates.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

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

}  // namespace

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
