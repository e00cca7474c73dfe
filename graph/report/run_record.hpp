#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "graph/run/runner.hpp"

namespace atrium::report {

/// What one run of a pipeline left: the folder of `atrium run`, or of one variant of a sweep.
struct RunRecord {
  struct Metric {
    std::string output;  ///< the pipeline's output that shows it
    Fact fact;
  };

  std::filesystem::path folder;
  std::string id;      ///< of a variant
  std::string status;  ///< "ok", "failed", "cancelled" or "running" (it was killed, or runs still)
  std::string message;
  std::vector<std::pair<std::string, std::string>> choices;  ///< of a variant: axis, label
  /// Address and value as resolved.yaml has them, in its order: "seed", "planes.type", "planes.in.cloud",
  /// "planes.max_planes". Versions of node types: "plane.ransac's version".
  std::vector<std::pair<std::string, std::string>> parameters;
  std::vector<NodeRecord> nodes;  ///< in an order in which they can run
  std::vector<Metric> metrics;
  std::vector<Artefact> files;       ///< relative to the folder
  std::vector<std::string> outside;  ///< files that the record lists and that are not in the folder
};

/// Reads result.json (of a variant) or manifest.json (of a run), and resolved.yaml. Throws Error if there is neither,
/// or if they cannot be understood.
RunRecord read_run(const std::filesystem::path& folder);

/// The name of a metric: its output's and its own, "shell.faces.triangles", or its own alone where that begins with the
/// output's, "faces.triangles".
std::string name_of(const RunRecord::Metric& metric);

}  // namespace atrium::report
