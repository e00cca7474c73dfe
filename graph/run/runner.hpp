#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "graph/cache/record.hpp"
#include "graph/pipeline/pipeline.hpp"
#include "graph/pipeline/png_stamp.hpp"

namespace atrium {

class Cache;

struct RunOptions {
  std::filesystem::path out;  ///< the run's folder; empty: nothing is recorded, nodes write into the working folder
  int threads = 0;            ///< 0: one per core; 1: strictly one after the other
  bool hashes = true;         ///< content hashes of outputs in the manifest
  bool keep_outputs = true;   ///< in RunResult::outputs; false: they are freed as other values are
  const std::atomic<bool>* cancel = nullptr;  ///< set it to end the run: no node is started after that
  /// What goes into the pictures of a node; empty: stamp_of() the pipeline.
  std::function<const PngStamp&(const PipelineNode& node)> stamp;
  const std::atomic<bool>* stop = nullptr;  ///< the same, but the nodes that run are let finish
  Cache* cache = nullptr;  ///< what earlier runs computed is not computed again; outputs are hashed in any case
};

enum class NodeStatus {
  ok,
  failed,
  skipped,    ///< a node that it depends on failed
  cancelled,  ///< the run was ended before this node was done
};
std::string_view name_of(NodeStatus status);

/// What the cache had of a node.
struct CacheUse {
  enum class Result { off, hit, miss } result = Result::off;
  std::string key;           ///< empty: the node has none
  std::string why;           ///< of a miss
  bool again = false;        ///< of a hit: the node was run all the same, because a value was needed that is not kept
  double wall = 0, cpu = 0;  ///< of a hit: what it took when it was computed
  std::uint64_t peak_memory = 0;  ///< of a hit: as it was then
  std::string made;               ///< of a hit: when that was
};

/// What became of one node. Seconds are since the run's start (`start`) or lengths of time.
struct NodeRecord {
  std::string node, type;
  int version = 1;  ///< of the type
  NodeStatus status = NodeStatus::cancelled;
  std::string message, help;  ///< of a failed node
  std::string because;  ///< of a skipped node: the failed node that it depends on (the first in the pipeline's order)
  double start = 0, wall = 0;
  /// CPU time of the thread that ran the node, and of other threads in the pieces of the node's Context loops. What a
  /// library does on threads of its own, or a node in bare oneTBB loops on other threads, is in the run's total only.
  double cpu = 0;
  double hash_start = 0,
         hash_wall = 0;  ///< sizing and hashing the outputs: after the nodes that read them were started
  /// Highest resident memory of the process up to the node's end, bytes; with one thread: while the node ran. With that
  /// of a program that computed for the node.
  std::uint64_t peak_memory = 0;
  int thread = 0;                     ///< which of the run's threads, from 0
  std::vector<OutputRecord> outputs;  ///< of a node that is ok
  std::vector<std::string> warnings;
  std::vector<Artefact> artefacts;  ///< relative to the run's folder
  CacheUse cache;

  NodeRecord() = default;
  /// Nothing has become of it yet.
  explicit NodeRecord(const PipelineNode& of) : node(of.path), type(of.type->type), version(of.type->version) {}

  bool is_hit() const { return cache.result == CacheUse::Result::hit; }
  bool is_from_cache() const { return is_hit() && !cache.again; }
  /// What computing it took, now or when it was.
  double computing_wall() const { return is_from_cache() ? cache.wall : wall; }
  double computing_cpu() const { return is_from_cache() ? cache.cpu : cpu; }
  std::uint64_t computing_memory() const { return is_from_cache() ? cache.peak_memory : peak_memory; }
};

struct NodeFailure {
  std::string node, type, message, help;
};

struct RunResult {
  std::vector<NodeFailure> failures;  ///< in the pipeline's order; empty and not cancelled: the run is complete
  bool cancelled = false;
  /// The pipeline's named outputs, as far as their values are there: the node is ok, and its value was not in the
  /// cache only (OutputRecord::facts has what is printed of it).
  std::map<std::string, Value> outputs;
  std::vector<NodeRecord> nodes;  ///< one per node of the pipeline, in its order
  int threads = 0;
  double wall = 0, cpu = 0;            ///< of the whole run; cpu: all threads of the process
  std::uint64_t peak_memory = 0;       ///< of the process, bytes
  std::string cache_folder;            ///< empty: there was no cache
  std::uint64_t loaded = 0, kept = 0;  ///< bytes of values, from and to the cache
  std::vector<std::string> cache_problems;
};

/// "ok", "failed" or "cancelled".
std::string_view status_of(const RunResult& run);
/// Fills in the failures and whether the run was ended, from what became of its nodes.
void sum_up(RunResult& run);

/// The run's folder cannot be used.
class FolderError : public Error {
 public:
  using Error::Error;
};

/// What tells a person how far a run is. Called from any thread.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  virtual void planned(std::size_t /*nodes*/) {}
  virtual void started(const std::string& /*node*/) {}
  virtual void progress(const std::string& /*node*/, double /*share*/) {}
  /// Of every node, also of one that was never started. Valid during the call only.
  virtual void finished(const NodeRecord& /*node*/) {}
  /// Of every node that is ok, after `finished`, when its outputs are sized and hashed.
  virtual void described(const NodeRecord& /*node*/) {}
  /// Of a node that was finished: what was told of it holds no longer, it will be finished once more.
  virtual void reopened(const std::string& /*node*/) {}
  /// `node` is empty if it is of the run as a whole.
  virtual void message(const std::string& /*node*/, std::string_view /*text*/, bool /*warning*/) {}
};

/// Runs a checked pipeline: independent nodes side by side on one oneTBB arena, which the nodes' own loops share; a
/// value is freed as soon as its last reader is done. A node that throws fails: what depends on it is skipped, the rest
/// is run. Writes resolved.yaml, manifest.json and trace.json into the run's folder (also when a node fails or the run
/// is cancelled). Results do not depend on the number of threads. Throws FolderError, and Error if the
/// pipeline is not one (nodes in a circle).
RunResult run_pipeline(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress);

}  // namespace atrium
