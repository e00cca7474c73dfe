#include "graph/run/runner.hpp"

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

std::string_view status_of(const RunResult& run) {
  return !run.failures.empty() ? "failed" : run.cancelled ? "cancelled" : "ok";
}

void sum_up(RunResult& run) {
  for (const auto& node : run.nodes) {
    if (node.status == NodeStatus::failed) run.failures.push_back({node.node, node.type, node.message, node.help});
    run.cancelled = run.cancelled || node.status == NodeStatus::cancelled;
  }
}

RunResult run_pipeline(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress) {
  RunOptions absolute = options;
  if (!options.out.empty()) absolute.out = std::filesystem::absolute(options.out).lexically_normal();
  Scheduler scheduler(pipeline, absolute, progress);
  if (options.out.empty()) return scheduler.run();
  RunFolder folder(absolute.out, pipeline);
  RunResult result = scheduler.run();
  folder.finish(result);
  return result;
}

}  // namespace atrium
