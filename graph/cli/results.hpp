#pragma once
#include <filesystem>
#include <string>

#include "graph/run/runner.hpp"

namespace atrium::cli {

/// The printable outputs of a run (numbers, texts, and types with `facts`) as an aligned table: name, value, unit.
/// Empty if there are none.
std::string results_table(const Pipeline& pipeline, const RunResult& result);

/// The same for scripts: {"status", "folder", "outputs": {output: {"value", "unit"} or {fact: {"value", "unit"}}},
/// "failures": [{"node", "type", "message", "help"}]}.
std::string results_json(const Pipeline& pipeline, const RunResult& result, const std::filesystem::path& folder);

}  // namespace atrium::cli
