#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace atrium::render {

/// The value below which `share` (0 to 1) of them lie. There must be one at least.
inline float quantile(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace atrium::render
