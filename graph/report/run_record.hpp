#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "graph/api/error.hpp"
#include "graph/api/value.hpp"

namespace atrium::report {

/// What one run of a pipeline left: the folder of `atrium run`, or of one variant of a sweep.
struct RunRecord {
  struct Output {
    std::string port, hash;  ///< hash: "" if none was taken
  };
  struct Node {
    std::string path, type, status;
    double wall = 0, cpu = 0;
    std::uint64_t peak_memory = 0;
    std::vector<Output> outputs;
    bool known = false;  ///< to the cache: times and memory are those of when it was computed
  };
  struct File {
    std::string path;  ///< relative to the folder, "/" between its parts
    std::uint64_t bytes = 0;
    std::string hash;  ///< "" if the record has none: hash_if_readable() takes it
  };
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
  std::vector<Node> nodes;  ///< in an order in which they can run
  std::vector<Metric> metrics;
  std::vector<File> files;
  std::vector<std::string> outside;  ///< files that the record lists and that are not in the folder
};

/// Reads result.json (of a variant) or manifest.json (of a run), and resolved.yaml. Throws Error if there is neither,
/// or if they cannot be understood.
RunRecord read_run(const std::filesystem::path& folder);

/// A whole JSON file. Throws Error.
nlohmann::json read_json(const std::filesystem::path& file);

/// The name of a metric: "faces.faces.triangles".
std::string name_of(const RunRecord::Metric& metric);

}  // namespace atrium::report
