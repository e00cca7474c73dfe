#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace atrium {

/// A process that is watched: what it prints is kept (beginning and end, up to a megabyte each), what it tells over a
/// pipe (its file 3) is read line by line. It ends with the thread that started it, however that ends.
class WorkerProcess {
 public:
  static constexpr int events_file = 3;
  /// Starts `arguments`, the first being the path of the program. Throws Error.
  explicit WorkerProcess(const std::vector<std::string>& arguments);
  ~WorkerProcess();  ///< ends it
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  pid_t id() const { return process_; }
  /// To be polled; -1 at the end of the stream.
  int events() const { return events_; }
  int output() const { return output_; }

  /// Reads what is there without waiting; returns whole lines of events.
  std::vector<std::string> read();
  /// How it ended, as waitpid(2) says it; nothing while it runs. Call read() once more after it.
  std::optional<int> ended();
  /// To it and to what it has started in its process group.
  void send(int signal) const;
  /// Memory of its own that is resident (no mapped files), bytes.
  std::uint64_t memory() const;
  /// What it printed. Between beginning and end a line tells how much is left out.
  std::string printed() const;

 private:
  bool read_events(std::vector<std::string>& lines);
  bool read_output();

  pid_t process_ = -1;
  int events_ = -1, output_ = -1;
  std::optional<int> status_;
  std::string line_, head_, tail_;
  std::uint64_t left_out_ = 0;
};

/// Ends and reaps the children of this process that are none of `known`: what an ended worker has left behind.
void end_orphans(const std::vector<pid_t>& known);

/// "signal 11 (SIGSEGV)", "exit code 3".
std::string how_ended(int status);

}  // namespace atrium
