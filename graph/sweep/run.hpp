#pragma once
#include "graph/sweep/result.hpp"

namespace atrium {

/// `out` is the sweep's folder; `stamp` and `stop` are not looked at.
struct SweepOptions : RunOptions {
  std::size_t max_failures = ~std::size_t{0};  ///< end the sweep when so many variants have failed
  std::uint64_t memory = 0;                    ///< of all processes together, in isolation; bytes; 0: any
  /// Each variant in a process of its own: the program, and what every worker is told of the cache.
  struct Isolation {
    std::string program;
    std::vector<std::string> arguments;
    double timeout = 0;  ///< seconds that a variant may take, and each node of what several share; 0: any
  };
  std::optional<Isolation> isolation;
};

struct SweepResult {
  std::vector<VariantResult> variants;  ///< in the plan's order
  bool cancelled = false;
  double wall = 0;
  std::uint64_t peak_memory = 0;
  std::size_t nodes = 0, cached = 0;  ///< nodes of the variants that were not done; of them those that the cache had
  std::vector<std::string> cache_problems;
};

/// Runs the variants that are not done yet, nodes that several share once, into OUT/variants/ID. A variant is recorded
/// (result.json) as soon as its last node is done: a sweep that is killed goes on where it was. A variant that fails
/// costs the others nothing. Writes table.csv, table.json, table.md and table.txt. Throws FolderError.
SweepResult run_sweep(const SweepFile& sweep, const SweepPlan& plan, const std::string& build,
                      const SweepOptions& options, ProgressSink& progress);

/// What run_sweep leaves of the sweep as a whole: its tables; and of a run of its merged graph, which goes into
/// `result`.
void write_tables(const std::filesystem::path& out, const SweepFile& sweep, const SweepPlan& plan,
                  const std::vector<VariantResult>& results);
void write_run(const std::filesystem::path& out, const Pipeline& pipeline, const RunResult& run,
               const std::string& started, SweepResult& result);

}  // namespace atrium
