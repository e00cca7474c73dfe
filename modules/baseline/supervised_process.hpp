#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace atrium::baseline {

/// A program and all that it starts, kept together by a small process between: orphans become its children (a
/// sub-reaper, prctl(2)), also those that have left the process group or the session, so none is lost.
class SupervisedProcess {
 public:
  /// No shell: an argument is what it is. `mebibytes`: address space of each process; 0: any. Throws Error if the
  /// program is missing.
  SupervisedProcess(std::vector<std::string> arguments, const std::filesystem::path& folder, double mebibytes);
  ~SupervisedProcess();  ///< kills what is left
  SupervisedProcess(const SupervisedProcess&) = delete;
  SupervisedProcess& operator=(const SupervisedProcess&) = delete;

  /// Waits at most so long for the program to print or end; appends what it printed.
  void wait(int milliseconds, std::string& printed);
  /// The status that waitpid(2) gives, once the program has ended.
  const std::optional<int>& status() const { return status_; }
  /// Why it could not be started, from errno.
  const std::optional<int>& failure() const { return failure_; }
  void terminate() const;  ///< SIGTERM to the program's group
  void end();              ///< SIGKILL to everything, until nothing is left
  /// The highest resident memory of the program, or of one that it started, as far as it was looked at: each time that
  /// wait() returns, every tenth of a second for the others.
  double peak_mebibytes() const { return peak_; }

 private:
  void look_at_memory();
  void read_messages();
  void close_all();

  pid_t supervisor_ = -1, program_ = -1;
  int log_ = -1, messages_ = -1;
  std::optional<int> status_, failure_;
  double peak_ = 0, looked_ = -1;
};

}  // namespace atrium::baseline
