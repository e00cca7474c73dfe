#include "graph/run/runner.hpp"

#include <algorithm>

#include "graph/api/clocks.hpp"
#include "graph/cache/cache.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/run/scheduler.hpp"

namespace atrium {

std::string_view name_of(NodeStatus status) {
  switch (status) {
    case NodeStatus::ok: return "ok";
    case NodeStatus::failed: return "failed";
    case NodeStatus::skipped: return "skipped";
    default: return "cancelled";
  }
}

void finish_cache(Cache* cache, RunResult& result) {
  if (cache == nullptr) return;
  cache->finish();
  Cache::Use use = cache->use();
  result.cache_folder = cache->places().folder.string();
  result.loaded = use.loaded;
  result.kept = use.kept;
  result.cache_problems = std::move(use.problems);
}

RunResult run_pipeline(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress) {
  RunOptions absolute = options;
  if (!options.out.empty()) absolute.out = std::filesystem::absolute(options.out).lexically_normal();
  Scheduler scheduler(pipeline, absolute, progress);
  if (options.out.empty()) {
    RunResult result = scheduler.run();
    finish_cache(options.cache, result);
    return result;
  }
  RunFolder folder(absolute.out, pipeline);
  const double wall = wall_seconds();
  const double cpu = process_cpu_seconds();
  RunResult result = scheduler.run();
  finish_cache(options.cache, result);
  result.wall = wall_seconds() - wall;
  result.cpu = process_cpu_seconds() - cpu;
  result.peak_memory = peak_memory();
  for (const auto& node : result.nodes) result.peak_memory = std::max(result.peak_memory, node.peak_memory);
  folder.finish(result);
  return result;
}

}  // namespace atrium
