#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/api/supervised_process.hpp"

namespace atrium {

/// A process of this program that runs a part of a sweep: what it prints is kept (beginning and end, up to a megabyte
/// each), what it tells over a pipe (its file 3) is read line by line.
class WorkerProcess {
 public:
  static constexpr int events_file = SupervisedProcess::events_file;
  /// Starts `arguments`, the first being the path of the program. Throws Error.
  explicit WorkerProcess(const std::vector<std::string>& arguments) : process_({arguments, {}, 0, true}) {}

  /// Files to be polled for news; -1: closed.
  std::vector<int> files() const { return process_.files(); }
  /// Reads what is there without waiting; returns whole lines of events.
  std::vector<std::string> read();
  /// How it ended, as waitpid(2) says it; nothing while it runs. Nothing that it has started is left then. Call read()
  /// once more after it.
  std::optional<int> ended();
  /// Why it could not be started, from errno; 0: it was, or it is not known yet.
  int failure() const { return process_.failure().value_or(0); }
  bool terminate() const { return process_.terminate(); }  ///< asks it to end
  void end() { process_.end(); }                           ///< ends it, and what it has started
  /// Memory of its own that is resident (no mapped files), bytes.
  std::uint64_t memory() const;
  /// What it printed. Between beginning and end a line tells how much is left out.
  std::string printed() const;

 private:
  void keep(const std::string& printed);

  SupervisedProcess process_;
  std::string line_, head_, tail_;
  std::uint64_t left_out_ = 0;
};

/// "signal 11 (SIGSEGV)", "exit code 3".
std::string how_ended(int status);

}  // namespace atrium
