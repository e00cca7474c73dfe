#pragma once
#include "graph/api/node.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Writes metrics as JSON. Dots in names nest, each leaf is {"value": …, "unit": "…"}, in the order of the inputs:
/// {"distance": {"cloud_to_mesh": {"rms": {"value": 0.0081, "unit": "m"}}}}. Numbers are the shortest that read back to
/// the same double. A value that is not finite becomes null, with a warning. A file called .csv gets lines instead:
/// name, value (empty if not finite), unit, under a line with these words. Error, naming the two inputs: a name that
/// stands twice, or that is a group of another (a and a.b); an empty name or part of one.
struct Write {
  static constexpr std::string_view type = "metric.write";
  static constexpr std::string_view summary = "Writes metrics into one JSON or CSV file.";
  struct In {
    Inputs<Metrics> metrics;
  };
  struct Params {
    OutputPath path{"metrics.json"};
  };
  static constexpr auto inputs = std::tuple{port<&In::metrics>("Any number of them, joined in this order.")};
  static constexpr auto params = std::tuple{param<&Params::path>("The file: .csv, else JSON.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
