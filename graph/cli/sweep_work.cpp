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
  int threads = 0;
  bool here = false, no_hashes = false;
  CacheChoice cache;
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
  limit_openmp(options.threads);
  const CancelOnSignal signals;
  Registry registry;
  const fs::path folder = fs::absolute(options.folder).lexically_normal();
  WorkerOptions worker{
      folder, options.build, options.skipped, folder / farm_folder / "scratch" / options.tasks.front(), {}};
  const auto cache = open_cache(options.cache);
  worker.run.cache = cache.get();
  worker.run.threads = options.threads;
  worker.run.hashes = !options.no_hashes;
  worker.run.cancel = signals.flag();
  EventSink events(WorkerProcess::events_file);
  run_worker(task_of(folder, options.tasks), worker, registry, events);
  return ok;
}

/// A task of a submission: each of its variants in a process of its own.
int work(const WorkArguments& options) {
  const CancelOnSignal signals;
  Registry registry;
  ConsoleProgress progress(console_options(stderr, false));
  run_shard(fs::absolute(options.folder).lexically_normal(), options.tasks.front(), own_program(), options.threads,
            build_of_all(registry), signals.flag(), registry, progress);
  return signals.flag()->load() ? signals.exit_code() : ok;
}

}  // namespace

std::vector<std::string> worker_arguments(const CacheChoice& choice, const Cache* cache, bool no_hashes) {
  std::vector<std::string> arguments;
  if (cache != nullptr) arguments = {"--cache", cache->places().folder.string(), "--cache-size", choice.size};
  if (no_hashes) arguments.emplace_back("--no-hashes");
  return arguments;
}

void limit_openmp(int threads) {
  ::setenv("OMP_NUM_THREADS", std::to_string(std::max(threads, 1)).c_str(),
           threads > 0 ? 1 : 0);  // NOLINT(concurrency-mt-unsafe)
}

std::string own_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) throw Error("cannot find this program: " + error.message());
  return program.string();
}

void add_sweep_work(CLI::App& sweep, int& exit_code) {
  auto* verb = sweep.add_subcommand("work", "What the processes of a sweep run; started by the other verbs.");
  const auto options = std::make_shared<WorkArguments>();
  verb->add_option("DIR", options->folder, "the sweep's folder")->required();
  verb->add_option("TASK", options->tasks, "a file in DIR/farm, or ids of variants")->required();
  verb->add_flag("--here", options->here, "in this process");
  verb->add_option("--skip", options->skipped, "ID/NODE: not this node, nor what depends on it")
      ->allow_extra_args(false);
  verb->add_option("--build", options->build, "what the sweep was begun with");
  verb->add_option("-j,--threads", options->threads, "threads")->check(CLI::Range(1, 1024));
  verb->add_flag("--no-hashes", options->no_hashes, "no content hashes of outputs");
  add_cache_options(*verb, options->cache);
  verb->callback([options, &exit_code] { exit_code = options->here ? work_here(*options) : work(*options); });
}

}  // namespace atrium::cli
