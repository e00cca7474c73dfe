#pragma once
#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "graph/sweep/worker_process.hpp"

namespace atrium {

struct PoolOptions {
  int threads = 0;                            ///< that all workers use together; 0: one per core
  std::uint64_t memory = 0;                   ///< bytes that all workers may hold together; 0: any
  double timeout = 0;                         ///< seconds; 0: none
  const std::atomic<bool>* cancel = nullptr;  ///< set it to end the workers
  const std::atomic<bool>* stop = nullptr;    ///< set it to start no more of them
};

struct PoolTask {
  std::size_t id = 0;                                                 ///< the caller's
  std::function<std::vector<std::string>(int threads)> command = {};  ///< its first word is the program's path
  /// What it will probably need, bytes; nothing: not known, it runs alone.
  std::function<std::optional<std::uint64_t>()> memory = [] { return std::nullopt; };
  bool timed_by_node = false;  ///< the time limit is for each node of it, not for all of it
  std::size_t place = 0;       ///< set when it is started: no two at the same time have the same
  bool alone = false;          ///< it needed more memory than there was beside others
};

struct PoolEnd {
  enum class How { done, crashed, cancelled } how = How::cancelled;
  std::string message;             ///< of a crash: "signal 11 (SIGSEGV) in node x/y"
  std::string reason;              ///< of a crash, without the node
  std::vector<std::string> nodes;  ///< that ran when it ended, "ID/x/y"
  std::string printed;
};

/// Runs tasks in processes of their own, as many side by side as there are threads and memory for. A worker alone that
/// needs more than all of the memory is ended, which counts as a crash; of several the last that was started is ended,
/// and started again when nothing else runs. Where the system refuses one more process, no more run side by side than
/// it has given; if it gives none, that is tried for a second. Not for several threads.
class WorkerPool {
 public:
  /// What a worker says while it runs, and how it ended. `on_end` may add tasks. After `on_end` no process of the task
  /// is left.
  using OnEvent = std::function<void(const PoolTask&, const nlohmann::ordered_json&)>;
  using OnEnd = std::function<void(const PoolTask&, const PoolEnd&)>;
  WorkerPool(PoolOptions options, OnEvent on_event, OnEnd on_end);
  ~WorkerPool();

  void add(PoolTask task);
  /// Returns when all tasks are done, or the run is cancelled or stopped and no worker is left. Of tasks that were
  /// never started nothing is told.
  void run();
  /// Called now and then while run() runs.
  std::function<void()> on_tick;

 private:
  struct Worker;
  void start_what_fits();
  bool fits(const PoolTask& task) const;
  void start(PoolTask task);
  bool try_again();
  void refused(PoolTask task, const std::string& why);
  void wait() const;
  void read(Worker& worker);
  void check(Worker& worker);
  void check_memory();
  void end(Worker& worker);
  bool cancelled() const;

  PoolOptions options_;
  OnEvent on_event_;
  OnEnd on_end_;
  std::deque<PoolTask> waiting_;
  std::vector<std::unique_ptr<Worker>> running_;
  std::size_t most_;                ///< workers side by side
  std::size_t refusals_alone_ = 0;  ///< how often the system has refused a process while there was none
  double cancelled_at_ = 0;
};

}  // namespace atrium
