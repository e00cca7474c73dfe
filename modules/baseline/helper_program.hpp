#pragma once
#include <filesystem>
#include <string>

#include "graph/api/context.hpp"
#include "modules/baseline/exchange.hpp"

namespace atrium::baseline {

/// A program that computes for a node in a process of its own: it can be stopped at a limit or when the run is
/// cancelled, and takes nothing with it when it crashes. Helpers that link libraries under the GPL leave the plugin
/// free of them.
struct HelperProgram {
  std::string name;      ///< its file, beside the plugin: "atrium-polyfit"
  std::string lacks;     ///< how to get it, when it is not there
  double seconds = 0;    ///< of wall time after which it is stopped
  double mebibytes = 0;  ///< of resident memory above which it is stopped; looked at a hundred times a second
};

struct HelperResult {
  Exchange reply;
  double seconds = 0;    ///< wall time
  double mebibytes = 0;  ///< peak of resident memory, looked at as often; the run adds it to the node's own
};

/// The file of a helper, whether it is there or not.
std::filesystem::path helper_file(const std::string& name);

/// Runs the helper and waits for its reply. Throws Error when it is not there, when it ran into a limit (saying into
/// which), crashed (with the last line that it printed) or says itself why it could not; Cancelled when
/// the run is to end.
HelperResult run_helper(const HelperProgram& helper, const Exchange& request, Context& context);

}  // namespace atrium::baseline
