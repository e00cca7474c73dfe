#pragma once
#include <algorithm>
#include <vector>

namespace atrium::floorplan {

struct Weighted {
  double value = 0, weight = 0;
};

/// The least value that has at least half of the weight at or below it; 0 of nothing.
inline double median(std::vector<Weighted> values) {
  std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) {
    return a.value != b.value ? a.value < b.value : a.weight < b.weight;
  });
  double total = 0, below = 0;
  for (const auto& v : values) total += v.weight;
  for (const auto& v : values)
    if ((below += v.weight) >= 0.5 * total) return v.value;
  return 0;
}

}  // namespace atrium::floorplan
