#include "modules/plane/local_spacing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "modules/geometry/quantile.hpp"

namespace atrium::plane {
namespace {

// Neighbours along the curve; where the curve jumps, it costs one or two long steps, which are left out.
constexpr std::size_t window = 32;
constexpr std::size_t left_out = 3;
constexpr std::size_t most_windows = 8192;

/// Prim's algorithm on the complete graph of `count` points from `begin` on.
float spacing_of(const PointColumns& columns, std::size_t begin, std::size_t count) {
  if (count < left_out + 2) return 0;
  std::array<float, window> step;
  step.fill(std::numeric_limits<float>::infinity());
  std::array<bool, window> reached{};
  std::array<float, window> edges{};
  std::size_t current = 0;
  for (std::size_t k = 1; k < count; ++k) {
    reached[current] = true;
    const Eigen::Vector3f p = columns.point(begin + current);
    std::size_t nearest = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (reached[i]) continue;
      step[i] = std::min(step[i], (columns.point(begin + i) - p).squaredNorm());
      if (nearest == count || step[i] < step[nearest]) nearest = i;
    }
    edges[k - 1] = step[nearest];
    current = nearest;
  }
  return std::sqrt(ranked(std::span(edges).first(count - 1), count - 2 - left_out));
}

}  // namespace

double LocalSpacing::reach(const std::vector<std::uint32_t>& places) const {
  constexpr std::size_t samples = 64;
  constexpr double least = 0.03;
  constexpr double reach_per_spacing = 1.05;
  std::vector<float> values;
  const std::size_t step = std::max<std::size_t>(1, places.size() / samples);
  for (std::size_t i = 0; i < places.size(); i += step) values.push_back(at(places[i]));
  if (values.empty()) return least;
  return std::max(least, reach_per_spacing * static_cast<double>(ranked(values, 3 * values.size() / 4)));
}

double LocalSpacing::quantile(double share) const {
  if (spacings_.empty()) return 0;
  return static_cast<double>(atrium::quantile(spacings_, share));
}

LocalSpacing::LocalSpacing(const MortonOrder& order, const Context& context) {
  const std::size_t total = order.index.size();
  stride_ = std::max(window, (total + most_windows - 1) / most_windows);
  spacings_.resize((total + stride_ - 1) / stride_);
  context.parallel_for(
      spacings_.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const std::size_t count = std::min(window, total);
          spacings_[i] = spacing_of(order.columns, std::min(i * stride_, total - count), count);
        }
      },
      128);
}

}  // namespace atrium::plane
