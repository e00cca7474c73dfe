#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

// Quantiles of numbers in no order: one of the numbers each, nothing is interpolated. There must be one number at
// least, and none that is NaN. In linear time (std::nth_element).
namespace atrium {

/// The number that `rank` others come before in ascending order: 0 is the least. `values` is a std::vector or a
/// std::span; it is in another order afterwards. Precondition: rank < size.
template <class Values>
auto ranked(Values&& values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The upper median, of rank size / 2: of an even count the greater of the two in the middle.
template <class T>
T median(std::vector<T> values) {
  return ranked(values, values.size() / 2);
}

/// The lower quantile, of rank share × (size - 1), rounded down; `share` is 0 to 1. For 0.5 and an even count it is the
/// smaller of the two in the middle.
template <class T>
T quantile(std::vector<T> values, double share) {
  return ranked(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// The least and the greatest number but for share × size of them, rounded down, at each end; `share` is below 0.5.
template <class T>
std::pair<T, T> trimmed_range(std::vector<T> values, double share) {
  const auto skip = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  const T low = ranked(values, skip);
  return {low, ranked(values, values.size() - 1 - skip)};
}

/// The least value that has at least `share` (0 to 1) of the weight at or below it. The pairs are values and weights,
/// of at least 0, and one at least. Takes O(n log n).
inline double weighted_quantile(std::vector<std::pair<double, double>> values, double share) {
  std::sort(values.begin(), values.end());
  double total = 0, below = 0;
  for (const auto& [value, weight] : values) total += weight;
  for (const auto& [value, weight] : values)
    if ((below += weight) >= share * total) return value;
  return values.back().first;
}

}  // namespace atrium
