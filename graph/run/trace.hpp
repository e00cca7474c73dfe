#pragma once
#include <string>

#include "graph/run/runner.hpp"

namespace atrium {

/// The run as a timeline in Chrome's trace format (chrome://tracing, https://ui.perfetto.dev): one row per thread of
/// the run, with the nodes that it ran and the hashing of their outputs, and the process's peak memory.
std::string trace_json(const RunResult& result);

}  // namespace atrium
