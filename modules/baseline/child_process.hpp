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
  std::filesystem::path log;           ///< takes what it prints, both streams in the order in which they came
  double seconds = 0;                  ///< wall time after which it is ended; 0: none
  double mebibytes = 0;                ///< address space of each of its processes (RLIMIT_AS); 0: any
};

struct ChildResult {
  double seconds = 0;    ///< wall time
  double mebibytes = 0;  ///< peak of resident memory
};

/// Runs the program to its end. What it started itself ends with it: all are of one process group, which gets SIGTERM
/// at the deadline or when the run is cancelled, and SIGKILL two seconds later. Throws Error if it is missing or cannot
/// be started, at the deadline, and if it fails (exit code or signal; the help is the end of the log); Cancelled.
ChildResult run_child(const ChildProcess& child, Context& context);

}  // namespace atrium::baseline
