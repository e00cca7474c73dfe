#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <queue>
#include <vector>

#include "graph/cache/cache.hpp"
#include "graph/pipeline/png_stamp.hpp"
#include "graph/run/cache_plan.hpp"
#include "graph/run/memory_watch.hpp"
#include "graph/run/runner.hpp"

namespace atrium {

/// Runs the nodes of one pipeline, once.
///
/// Order: of the nodes that can run, the one that became ready last goes first (depth first, so that few values are
/// alive); of those that became ready together, first one that nothing reads (it frees its inputs and keeps nothing),
/// then the one with the longest way to an end, then the first in the file.
///
/// With a cache all nodes are decided first (plan_with_cache), then the plan is executed: a node goes when all that it
/// reads is done, and is taken from the cache or run. Values that are kept are loaded when the first node that reads
/// them runs. If one cannot be loaded after all (its file is damaged, or somebody has removed it), the node that reads
/// it and what follows are left for another round: what is left is planned again, now knowing that, and executed. A
/// node that is run again for its value and gives another one than before (a library has changed, or it depends on more
/// than its key holds) replaces its record, and in the next round all that depends on it is done anew.
class Scheduler {
 public:
  Scheduler(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress);
  RunResult run();

 private:
  using Inputs = std::vector<std::vector<Value>>;
  struct Ready {
    std::size_t stamp, node;
    bool is_end;
    std::size_t remaining;
    bool operator<(const Ready& other) const;
  };
  struct State {
    std::vector<Value> values;         ///< per output; null when not made or loaded, or no longer needed
    std::vector<std::size_t> readers;  ///< per output: reads that are to come, of nodes and of the pipeline's outputs
    std::size_t remaining = 1;         ///< nodes on the longest way to an end, itself included
    bool settled = false;              ///< it is done, or cannot run any more
    bool blocked = false;              ///< it cannot run any more
    bool told = false;                 ///< the progress has heard of its end, and was not told to forget it
    std::size_t blocker = 0;           ///< the first failed node that it depends on, or the number of nodes
    // Of a round:
    bool scheduled = false;
    std::size_t waits = 0;  ///< edges from scheduled nodes that are not done yet
    // With a cache:
    std::vector<std::string> hashes;  ///< per output, when it is settled
    CacheLookup found;                ///< when it is executed
    bool unloadable = false;          ///< a value that was said to be kept could not be loaded
    bool unreplayable = false;        ///< a file that its record names is not kept
    bool drifted = false;             ///< run again for its value, it gave another one
    bool has_new_values = false;      ///< that was in this round
    double cost = 0;                  ///< seconds to have its values again; 0: they are kept
    std::vector<Artefact> kept;       ///< the files that it wrote
  };

  bool cancelled() const;
  bool stopping() const;
  void prepare();
  void begin_round();
  std::size_t schedule();
  void guarded_step();
  void end_by(std::exception_ptr problem);
  void step();
  void execute(std::size_t n);
  bool call_watched(std::size_t n, Inputs inputs, std::vector<Value>& outputs, std::optional<std::uint64_t>& growth);
  bool call(std::size_t n, const Inputs& inputs, std::vector<Value>& outputs);
  void fail(std::size_t n, std::string message, std::string help);
  void tell(std::size_t n);
  bool note_facts(std::size_t n, const std::vector<Value>& outputs);
  void describe(std::size_t n, const std::vector<Value>& outputs);
  void finish(std::size_t n, const std::vector<Value>& outputs);
  void settle(std::size_t n, const std::vector<Value>& outputs);
  RunResult result();
  // With a cache (cached_nodes.cpp):
  void note_builds();
  void hash_inputs();
  void plan_round();
  void reopen_readers_of_new_values();
  void reopen(std::size_t n);
  bool stands_still();
  bool take_from_cache(std::size_t n);
  bool is_planned_for_what_is(std::size_t n) const;
  bool replay(std::size_t n, const CacheRecord& found);
  bool load_inputs(std::size_t n);
  std::string compare_with_record(std::size_t n);
  void run_for_values(std::size_t n);
  void take_new_values(std::size_t n, const std::string& drift);
  void keep(std::size_t n, const std::vector<Value>& outputs, std::optional<std::uint64_t> growth);
  double cost_of_inputs(std::size_t n) const;
  // With mutex_ held:
  void push(std::size_t n);
  Inputs values_for(std::size_t n) const;
  void keep_outputs(std::size_t n, const std::vector<Value>& outputs);
  /// What a long node has freed goes back to the system.
  void give_back_memory_of(const NodeRecord& record);
  void release_inputs(std::size_t n, std::vector<Value>& garbage);
  void block(std::size_t follower, std::size_t by);
  bool pass_over(std::size_t n, std::vector<Value>& garbage);
  std::size_t release_followers(std::size_t n, std::vector<Value>& garbage, std::vector<std::size_t>& passed);

  const Pipeline& pipeline_;
  const RunOptions& options_;
  ProgressSink& progress_;
  Cache* cache_;
  std::vector<std::size_t> order_;
  std::vector<PlannedNode> plan_;  ///< of this round; while it is executed each node takes what was found of it
  PngStamp picture_stamp_;
  double start_ = 0, start_cpu_ = 0;
  std::atomic<std::uint64_t> peak_memory_ = 0;
  std::function<void(std::size_t)> spawn_;  ///< lets so many threads of the run call step()

  std::mutex mutex_;
  std::priority_queue<Ready> ready_;
  std::size_t stamp_ = 0;
  std::size_t lost_ = 0;        ///< nodes of this round that lack a value, or give a new one
  std::size_t settled_ = 0;     ///< nodes that were settled in this round
  std::size_t findings_ = 0;    ///< nodes of which a round found that their values or files cannot be had as they were
  std::exception_ptr problem_;  ///< the first that ended the run, such as a record that cannot be written
  std::atomic<bool> ended_ = false;  ///< by it
  MemoryWatch memory_watch_;
  std::vector<State> states_;
  RunResult result_;
};

}  // namespace atrium
