#pragma once
#include <string>
#include <vector>

#include "graph/run/runner.hpp"

namespace atrium {

/// What happened in a run, for people and scripts: the program, the run, and each node with its times, memory, outputs,
/// warnings and files. Keys are always in the same order. Times and memory are in seconds and bytes.
std::string manifest_json(const Pipeline& pipeline, const RunResult& result, const std::string& started);

/// The manifest of a run that is under way ("status": "running"): what a killed run leaves. It lists as planned what
/// the run is going to write, and what it is about to remove of an earlier one.
std::string unfinished_manifest(const Pipeline& pipeline, const std::string& started,
                                const std::vector<std::string>& to_remove);

}  // namespace atrium
