#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace atrium {

/// The file of a program: a path that can be executed, or a name that is looked for in PATH. Throws Error.
std::filesystem::path program_file(const std::string& name);

/// Runs a program to its end with this process's standard streams and returns the status that waitpid(2) gives. No
/// shell: an argument is what it is. Throws Error if it cannot be started.
int run_program(const std::vector<std::string>& arguments);

/// A program and all that it starts, kept together by a small process between: orphans become its children (a
/// sub-reaper, prctl(2)), also those that have left the process group or the session, so none is lost. No process but
/// these is ever killed or waited for. They end when the thread that started them ends.
class SupervisedProcess {
 public:
  struct Start {
    std::vector<std::string> arguments;  ///< the first is the program; no shell: an argument is what it is
    std::filesystem::path folder = {};   ///< its working folder; empty: this one's
    double mebibytes = 0;                ///< address space of each process; 0: any
    bool tells = false;                  ///< it writes events into its file 3
  };
  static constexpr int events_file = 3;
  /// Throws Error if the program is missing.
  explicit SupervisedProcess(const Start& start);
  ~SupervisedProcess();  ///< kills what is left
  SupervisedProcess(const SupervisedProcess&) = delete;
  SupervisedProcess& operator=(const SupervisedProcess&) = delete;

  /// Waits at most so long for the program to print or end; appends what it printed.
  void wait(int milliseconds, std::string& printed);
  /// Without waiting: what it printed is appended, and what it told as events.
  void read(std::string& printed, std::string& events);
  /// Files to be polled for news; -1: closed.
  std::vector<int> files() const { return {messages_, log_, events_}; }
  /// The status that waitpid(2) gives, once the program has ended.
  const std::optional<int>& status() const { return status_; }
  /// Why it could not be started, from errno.
  const std::optional<int>& failure() const { return failure_; }
  bool terminate() const;                ///< SIGTERM to the program's group; false: it is not there yet
  pid_t id() const { return program_; }  ///< of the program; -1: not started yet
  void end();                            ///< SIGKILL to everything, until nothing is left
  /// The highest resident memory of the program, or of one that it started, as far as it was looked at: each time that
  /// wait() returns, every tenth of a second for the others.
  double peak_mebibytes() const { return peak_; }

 private:
  void look_at_memory();
  void read_messages();
  void close_all();

  pid_t supervisor_ = -1, program_ = -1;
  int log_ = -1, messages_ = -1, events_ = -1;
  std::optional<int> status_, failure_;
  double peak_ = 0, looked_ = -1;
};

}  // namespace atrium
