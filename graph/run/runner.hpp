#pragma once
#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "graph/pipeline/pipeline.hpp"

namespace atrium {

struct RunOptions {
  std::filesystem::path out;  ///< the run's folder
  int threads = 0;            ///< 0: one per core
  bool hashes = true;         ///< content hashes of outputs in the manifest
  std::atomic<bool>* cancel = nullptr;
};

struct NodeFailure {
  std::string node, type, message, help;
};

struct RunResult {
  std::vector<NodeFailure> failures;  ///< empty: the run is complete
  bool cancelled = false;
  std::map<std::string, Value> outputs;  ///< the pipeline's named outputs
};

/// What tells a person how far a run is. One live line on a terminal, plain lines otherwise; safe from any thread.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  virtual void started(const std::string& /*node*/) {}
  virtual void progress(const std::string& /*node*/, double /*share*/) {}
  virtual void finished(const std::string& /*node*/, double /*seconds*/) {}
  virtual void message(const std::string& /*node*/, std::string_view /*text*/, bool /*warning*/) {}
};

/// Runs a checked pipeline: independent nodes side by side on one oneTBB arena, a value freed as soon as its last
/// reader is done. Writes resolved.yaml, manifest.json and trace.json into the run's folder (also when a node fails).
RunResult run_pipeline(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress);

}  // namespace atrium
