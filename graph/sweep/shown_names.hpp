#pragma once
#include <set>
#include <string>

#include "graph/pipeline/findings.hpp"
#include "graph/sweep/sweep_file.hpp"

namespace atrium {

/// Checks that what a sweep's table and sheets show is there, before anything runs: outputs, nodes and units of
/// `metrics`, pictures of `pictures`. What an output shows is known only when it has been computed: a metric of that
/// name that no variant has is an error of the finished sweep.
class ShownNames {
 public:
  ShownNames(const SweepFile& sweep, Findings& findings) : sweep_(sweep), findings_(findings) {}
  /// A variant's pipeline, all of which must have the metrics.
  void add(const Pipeline& pipeline);
  /// Pictures must be those of one variant at least.
  void check_pictures();
  void check_units();

 private:
  void check_output(const SweepMetric& metric, const Pipeline& pipeline);
  void check_node(const SweepMetric& metric, const Pipeline& pipeline);

  const SweepFile& sweep_;
  Findings& findings_;
  std::set<std::string> files_;  ///< that variants write, as seen from their folders
};

}  // namespace atrium
