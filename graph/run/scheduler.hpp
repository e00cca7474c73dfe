#pragma once
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <queue>
#include <vector>

#include "graph/cache/cache.hpp"
#include "graph/pipeline/png_stamp.hpp"
#include "graph/run/admission.hpp"
#include "graph/run/memory_watch.hpp"
#include "graph/run/plan.hpp"
#include "graph/run/runner.hpp"

namespace atrium {

/// Runs the nodes of one pipeline, once.
///
/// Order: of the nodes that can run, the one that became ready last goes first (depth first, so that few values are
/// alive); of those that became ready together, first one that nothing reads (it frees its inputs and keeps nothing),
/// then the one with the longest way to an end, then the first in the file.
///
/// With a cache a node goes through up to three steps. Look: when the hashes of its inputs are known, so is its key. If
/// the cache has the record, the node is done: its outputs' hashes are known, their values are not loaded. Else it is
/// run, and the values that it lacks are fetched first: loaded, or, if they are not kept, made by running the node that
/// they are of again (which may lack values, too).
class Scheduler {
 public:
  Scheduler(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress);
  /// Everything of the result but what the run as a whole took.
  RunResult run();

 private:
  using Inputs = std::vector<std::vector<Value>>;
  enum class Step { look, fetch, run };
  struct Ready {
    std::size_t stamp, node;
    bool is_end;
    std::size_t remaining;
    Step step;
    bool operator<(const Ready& other) const;
  };
  struct State {
    std::vector<Value> values;  ///< per output; null when not made or loaded, or no longer needed
    bool blocked = false;       ///< it cannot run any more
    std::size_t blocker = 0;    ///< the first failed node that it depends on, or the number of nodes
    bool settled = false;       ///< its followers know what became of it
    // With a cache:
    std::vector<std::string> hashes;      ///< per output, when it is settled
    NodeKey key;                          ///< empty: it has none
    std::vector<std::string> files;       ///< fingerprints of the files that it reads, as they were for the key
    std::vector<char> wanted;             ///< outputs whose values others wait for
    std::vector<std::size_t> waiters;     ///< nodes that wait for them
    bool under_way = false;               ///< they are being fetched
    std::size_t lacking = 0;              ///< nodes whose values it waits for
    double cost = 0;                      ///< seconds to have its values again; 0: they are kept
    std::vector<CacheRecord::File> kept;  ///< the files that it wrote
  };

  void step();
  void execute(std::size_t n);
  bool call_watched(std::size_t n, Inputs inputs, std::vector<Value>& outputs, std::optional<std::uint64_t>& growth);
  void give_memory_back(std::size_t n, std::optional<std::uint64_t> growth);
  bool call(std::size_t n, const Inputs& inputs, std::vector<Value>& outputs);
  void fail(std::size_t n, std::string message, std::string help);
  void note_facts(std::size_t n, const std::vector<Value>& outputs);
  void describe(std::size_t n, const std::vector<Value>& outputs);
  void settle(std::size_t n, const std::vector<Value>& outputs);
  bool cancelled() const;
  bool stopping() const;
  // With a cache (demand.cpp):
  void note_builds();
  void look(std::size_t n);
  bool find_key(std::size_t n);
  bool replay(std::size_t n, const CacheRecord& found);
  void settle_with_cache(std::size_t n, const std::vector<Value>& outputs);
  void fetch(std::size_t p);
  void settle_again(std::size_t n, const std::vector<Value>& outputs);
  void abandon(std::size_t n);
  void drop_waiters(std::size_t n);
  bool hashes_are_right(std::size_t n);
  void keep(std::size_t n, const std::vector<Value>& outputs, std::optional<std::uint64_t> growth);
  double cost_of_inputs(std::size_t n);
  // With mutex_ held:
  void push(std::size_t n, Step step);
  std::size_t retry_refused();
  std::optional<std::size_t> lost_producer(std::size_t n);
  std::size_t demand(std::size_t n);
  std::size_t wake(std::size_t p);
  std::vector<std::size_t> take_waiters(std::size_t p);
  void lose(std::size_t n, std::size_t by);
  Inputs inputs_of(std::size_t n) const;
  void keep_outputs(std::size_t n, const std::vector<Value>& outputs);
  void release_inputs(std::size_t n, std::vector<Value>& garbage);
  void block(std::size_t follower, std::size_t by);
  void pass_over(std::size_t n, std::vector<Value>& garbage);
  std::size_t release_followers(std::size_t n, std::vector<Value>& garbage, std::vector<std::size_t>& passed);

  const Pipeline& pipeline_;
  const RunOptions& options_;
  ProgressSink& progress_;
  Cache* cache_;
  Plan plan_;
  PngStamp picture_stamp_;
  double start_ = 0;
  std::atomic<std::uint64_t> peak_memory_ = 0;
  std::function<void(std::size_t)> spawn_;  ///< lets so many threads of the run call step()

  std::mutex mutex_;
  std::priority_queue<Ready> ready_;
  std::size_t stamp_ = 0;
  Admission admission_;
  MemoryWatch memory_watch_;
  std::vector<State> states_;
  RunResult result_;
};

}  // namespace atrium
