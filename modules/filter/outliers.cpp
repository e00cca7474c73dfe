#include "modules/filter/outliers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/api/text.hpp"
#include "modules/filter/kept.hpp"
#include "modules/filter/spacing.hpp"

namespace atrium::filter {
namespace {

constexpr std::size_t chunk_size = 4096;
constexpr std::size_t sample_size = std::size_t{1} << 17U;

/// The largest distance that is normal: mean + deviations · σ over the distances that are at most `limit`.
double next_limit(const std::vector<float>& distances, double limit, double deviations, const Context& context) {
  struct Sums {
    double n = 0, sum = 0, squares = 0;
  };
  std::vector<Sums> chunks((distances.size() + chunk_size - 1) / chunk_size);
  context.parallel_chunks(distances.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t i = begin; i < end; ++i) {
      const auto d = static_cast<double>(distances[i]);
      if (d > limit) continue;
      sums.n += 1;
      sums.sum += d;
      sums.squares += d * d;
    }
    chunks[chunk] = sums;
  });
  Sums all;
  for (const Sums& s : chunks) {
    all.n += s.n;
    all.sum += s.sum;
    all.squares += s.squares;
  }
  const double mean = all.sum / all.n;
  const double deviation = std::sqrt(std::max(0.0, all.squares / all.n - mean * mean));
  return mean * (1 + 1e-5) + deviations * deviation;  // rounding alone must not make outliers of even spacing
}

}  // namespace

Outliers::Out Outliers::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  const auto k = static_cast<std::size_t>(params.neighbours);
  if (cloud.size() <= k) {
    if (cloud.size() > 0)
      context.warn(fmt::format("{} too few to find outliers by {} neighbours",
                               counted(cloud.size(), "point is", "points are"), k));
    return {cloud, 0};
  }
  const Spacing spacing(cloud.points, k, context);
  const std::vector<float> distances = spacing.sample(sample_size, context);
  double limit = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 10; ++round) {
    const double next = next_limit(distances, limit, params.deviations, context);
    if (!(next < limit / 2)) break;
    limit = next;
  }
  Out out{kept(cloud, spacing.at_most(limit, context))};
  out.removed = static_cast<std::int64_t>(cloud.size() - out.cloud.size());
  return out;
}

}  // namespace atrium::filter
