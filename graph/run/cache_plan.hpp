#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "graph/cache/cache.hpp"
#include "graph/pipeline/pipeline.hpp"

namespace atrium {

/// What the cache has of a node whose inputs are known.
struct CacheLookup {
  NodeKey key;                     ///< empty: it has none
  std::vector<std::string> files;  ///< fingerprints of the files that it reads, as they were for the key
  std::optional<CacheRecord> record;
  std::string why;  ///< why there is no record
};
/// `inputs`: the content hashes of the values on each input.
CacheLookup look_up(const PipelineNode& node, const std::vector<std::vector<std::string>>& inputs, Cache& cache);

/// What is done with a node of a run that has a cache. All nodes are decided before the first one runs.
struct PlannedNode {
  enum class Decision {
    hit,    ///< its record is there: its outputs' hashes are known, their values are loaded when they are needed
    again,  ///< its record is there; it is run all the same, for a value that is needed and not kept
    run,    ///< there is no record
    open    ///< what it reads is not known before other nodes are run: it is looked up then
  };
  Decision decision = Decision::run;
  CacheLookup found;                ///< of a node that is not open
  std::vector<std::string> hashes;  ///< of its outputs; empty: not known
  std::vector<char> needed;         ///< per output: whether a node that is or may be run reads its value

  bool may_run() const { return decision != Decision::hit; }
};

/// What a plan is made from besides the graph and the cache.
struct CachePlanOptions {
  /// The hashes of the outputs of a node that is done, none if it failed; null if it is not done. None is done without
  /// this function.
  std::function<const std::vector<std::string>*(std::size_t node)> done = {};
  /// Whether the value of an output can be had without running its node; without this function: if the cache has it.
  std::function<bool(std::size_t node, std::size_t output, const std::string& hash)> has_value = {};
  /// Whether a node's record is not to be used, because a file that it names is gone; without this function all are.
  std::function<bool(std::size_t node)> unusable = {};
  std::function<bool()> stop = {};  ///< ends the planning: what is not decided is open
};

/// `order`: the nodes, sources before readers.
std::vector<PlannedNode> plan_with_cache(const Dataflow& graph, const std::vector<std::size_t>& order, Cache& cache,
                                         const CachePlanOptions& options = {});

}  // namespace atrium
