#pragma once
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"
#include "graph/sweep/run.hpp"

namespace atrium::cli {

struct LoadedSweep {
  std::unique_ptr<SweepFile> sweep;
  SweepLoad load;
};
/// Null sweep: it is invalid, and that has been said.
LoadedSweep load_sweep(const std::string& file, const std::vector<Override>& settings, Registry& registry);

/// The table on stdout, what is wrong with metrics' names on stderr; returns the exit code.
int print_sweep(const SweepFile& sweep, const SweepPlan& plan, const SweepResult& result, bool json);
/// How many variants are what, on stderr.
void print_summary(const SweepResult& result, const std::filesystem::path& folder);
/// Draws the sheets, prints all of it, returns the exit code.
int finish_sweep(const LoadedSweep& loaded, const SweepResult& result, Registry& registry, const SweepOptions& options,
                 bool json, bool quiet);
}  // namespace atrium::cli
