#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::baseline {

/// A program, its arguments and its limits. No shell is in between: an argument is what it is.
struct ChildProcess {
  std::vector<std::string> arguments;  ///< the first is the program: a path, or a name to be found in PATH
  std::filesystem::path folder;        ///< its working folder
  double seconds = 0;                  ///< wall time after which it is ended; 0: none
  double mebibytes = 0;                ///< address space of each of its processes (RLIMIT_AS); 0: any
};

/// What a program printed, both streams in the order in which they came: the beginning and the end.
class ChildLog {
 public:
  static constexpr std::size_t most = 8U << 20U;  ///< bytes of the beginning, and of the end
  void add(const std::string& text);
  /// Between beginning and end a line tells how many bytes are left out.
  std::string text() const;
  std::string tail() const;  ///< the last thousand bytes, for an error's help

 private:
  std::string head_, end_;
  std::size_t left_out_ = 0;
};

struct ChildResult {
  double seconds = 0;    ///< wall time
  double mebibytes = 0;  ///< peak of resident memory of its largest process
};

/// Runs the program to its end. What it started itself ends with it, daemons too: at the deadline or when the run is
/// cancelled its process group gets SIGTERM, and two seconds later, or when the program has ended, whatever is left
/// SIGKILL. Throws Error if it is missing or cannot be started, at the deadline, and if it fails (exit code or signal;
/// the help is the end of the log); Cancelled.
ChildResult run_child(const ChildProcess& child, ChildLog& log, Context& context);

}  // namespace atrium::baseline
