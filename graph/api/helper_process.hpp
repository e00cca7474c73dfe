#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "graph/api/context.hpp"

namespace atrium {

/// A program that works for a node in a process of its own: it can be stopped at a limit or when the run is cancelled,
/// and takes nothing with it when it crashes or a library that it links ends it.
struct HelperProcess {
  std::string name;            ///< as errors call it: "atrium-polyfit"
  std::filesystem::path file;  ///< that exists
  double seconds = 0;          ///< of wall time after which it is stopped; 0: none
  double mebibytes = 0;  ///< of resident memory above which it is stopped, looked at a hundred times a second; 0: any
  std::string at_time_limit, at_memory_limit;  ///< what helps there
};

struct HelperReply {
  std::string bytes;     ///< its standard output
  double seconds = 0;    ///< wall time
  double mebibytes = 0;  ///< peak of resident memory, looked at as often; the run adds it to the node's own
};

/// Runs the program with the request on its standard input and waits for its end. Throws Error when it ran into a limit
/// (saying into which), crashed or ended with another code than 0 (with the last line that it printed on its standard
/// error); Cancelled when the run is to end.
HelperReply run_helper_process(const HelperProcess& helper, std::string_view request, const Context& context);

/// The folder of the library that holds `address` (of a function or a variable): where a plugin's helpers are
/// installed.
std::filesystem::path folder_of_library(const void* address);

}  // namespace atrium
