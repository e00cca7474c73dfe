#pragma once
#include <atomic>
#include <functional>
#include <mutex>
#include <queue>
#include <vector>

#include "graph/pipeline/png_stamp.hpp"
#include "graph/run/plan.hpp"
#include "graph/run/runner.hpp"

namespace atrium {

/// Runs the nodes of one pipeline, once.
///
/// Order: of the nodes that can run, the one that became ready last goes first (depth first, so that few values are
/// alive); of those that became ready together, first one that nothing reads (it frees its inputs and keeps nothing),
/// then the one with the longest way to an end, then the first in the file.
class Scheduler {
 public:
  Scheduler(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress);
  /// Everything of the result but what the run as a whole took.
  RunResult run();

 private:
  using Inputs = std::vector<std::vector<Value>>;
  struct Ready {
    std::size_t stamp, node;
    bool is_end;
    std::size_t remaining;
    bool operator<(const Ready& other) const;
  };

  void step();
  void execute(std::size_t n);
  bool call(std::size_t n, const Inputs& inputs, std::vector<Value>& outputs);
  void fail(std::size_t n, std::string message, std::string help);
  void describe(std::size_t n, const std::vector<Value>& outputs);
  void settle(std::size_t n, const std::vector<Value>& outputs);
  bool cancelled() const;
  bool stopping() const;
  // With mutex_ held:
  Inputs inputs_of(std::size_t n) const;
  void keep_outputs(std::size_t n, const std::vector<Value>& outputs);
  void release_inputs(std::size_t n, std::vector<Value>& garbage);
  void block(std::size_t follower, std::size_t by);
  std::size_t release_followers(std::size_t n, std::vector<Value>& garbage, std::vector<std::size_t>& blocked);

  const Pipeline& pipeline_;
  const RunOptions& options_;
  ProgressSink& progress_;
  Plan plan_;
  PngStamp picture_stamp_;
  double start_ = 0;
  std::atomic<std::uint64_t> peak_memory_ = 0;
  std::function<void(std::size_t)> spawn_;  ///< lets so many threads of the run call step()

  std::mutex mutex_;
  std::priority_queue<Ready> ready_;
  std::size_t stamp_ = 0;
  std::vector<std::vector<Value>> values_;  ///< [node][output]; null when not made yet or no longer needed
  std::vector<char> blocked_;               ///< per node: it cannot run any more
  std::vector<std::size_t> blocker_;        ///< per node: the first failed node that it depends on, or nodes.size()
  RunResult result_;
};

}  // namespace atrium
