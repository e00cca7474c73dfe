#pragma once
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace atrium {

struct Metric {
  static constexpr auto members() { return std::tuple{&Metric::name, &Metric::value, &Metric::unit}; }
  std::string name;  ///< dotted path, from general to particular: "distance.cloud_to_mesh.rms"
  double value = 0;
  std::string unit;  ///< "m", "m2", "deg", "s", "" for counts and shares
};

/// Measured numbers, in the order in which they are to be shown. Names are unique.
struct Metrics {
  static constexpr std::string_view port_type = "Metrics";
  static constexpr auto members() { return std::tuple{&Metrics::values}; }
  std::vector<Metric> values;
};

}  // namespace atrium
