// atrium sweep work DIR TASK: what the processes of a sweep run.
#include <fcntl.h>
#include <fmt/format.h>

#include "graph/api/files.hpp"
#include "graph/api/standard_streams.hpp"
#include "graph/cache/build_ids.hpp"
#include "graph/cli/signals.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/farm/submission.hpp"
#include "graph/pipeline/registry.hpp"
#include "graph/run/console_progress.hpp"
#include "graph/sweep/isolated_run.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

struct WorkArguments {
  std::string folder;
  std::vector<std::string> tasks, skipped;
  std::string build;
  bool here = false;
  RunChoice run;
};

/// A file in the work folder, or ids of variants.
WorkerTask task_of(const fs::path& folder, const std::vector<std::string>& names) {
  const fs::path file = folder / farm_folder / names.front();
  if (names.size() == 1 && fs::is_regular_file(file)) return read_task(read_text(file), file.string());
  WorkerTask task;
  for (const auto& name : names) task.parts.push_back({name, {}});
  return task;
}

int work_here(const WorkArguments& options) {
  keep_occupied(WorkerProcess::events_file, O_WRONLY);       // before any file is opened
  ::fcntl(WorkerProcess::events_file, F_SETFD, FD_CLOEXEC);  // not for programs that nodes start
  limit_openmp(options.run.threads);
  const CancelOnSignal signals;
  Registry registry;
  const fs::path folder = fs::absolute(options.folder).lexically_normal();
  const auto cache = open_cache(options.run);
  WorkerOptions worker{folder, options.build, options.skipped, folder / farm_folder / "scratch" / options.tasks.front(),
                       run_options<RunOptions>(options.run, cache.get(), {})};
  worker.run.cancel = signals.flag();
  EventSink events(WorkerProcess::events_file);
  run_worker(task_of(folder, options.tasks), worker, registry, events);
  return ok;
}

/// A task of a submission: each of its variants in a process of its own.
int work(const WorkArguments& options) {
  const CancelOnSignal signals;
  Registry registry;
  const StandardOutputSetAside results_only;
  ConsoleProgress progress(console_options(stderr, false));
  run_shard(fs::absolute(options.folder).lexically_normal(), options.tasks.front(), own_program(), options.run.threads,
            build_of_all(registry), signals.flag(), registry, progress);
  return signals.flag()->load() ? signals.exit_code() : ok;
}

}  // namespace

void add_sweep_work(CLI::App& sweep, int& exit_code) {
  auto* verb = sweep.add_subcommand("work", "What the processes of a sweep run; started by the other verbs.");
  const auto options = std::make_shared<WorkArguments>();
  verb->add_option("DIR", options->folder, "the sweep's folder")->required();
  verb->add_option("TASK", options->tasks, "a file in DIR/farm, or ids of variants")->required();
  verb->add_flag("--here", options->here, "in this process");
  verb->add_option("--skip", options->skipped, "ID/NODE: not this node, nor what depends on it")
      ->allow_extra_args(false);
  verb->add_option("--build", options->build, "what the sweep was begun with");
  add_threads(*verb, options->run.threads, "threads");
  verb->add_flag("--no-hashes", options->run.no_hashes, "no content hashes of outputs");
  add_cache_options(*verb, options->run.cache);
  verb->callback([options, &exit_code] { exit_code = options->here ? work_here(*options) : work(*options); });
}

}  // namespace atrium::cli
