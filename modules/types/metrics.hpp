#pragma once
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "graph/api/value.hpp"

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
  static std::vector<Fact> facts(const Metrics& metrics) {
    std::vector<Fact> facts;
    facts.reserve(metrics.values.size());
    for (const auto& m : metrics.values) facts.push_back({m.name, m.value, m.unit});
    return facts;
  }
  std::vector<Metric> values;
};

}  // namespace atrium
