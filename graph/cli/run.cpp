// atrium run FILE: runs a pipeline into a folder. Progress on stderr, results on stdout.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>

#include "graph/api/standard_streams.hpp"
#include "graph/cli/results.hpp"
#include "graph/cli/signals.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"
#include "graph/run/console_progress.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  std::string file;
  std::vector<std::string> settings;
  std::string out;
  RunChoice run;
};

// runs/paper-20240131-093000, or the first of …-2, …-3 that is not there.
fs::path new_folder(const fs::path& file) {
  const auto name = fmt::format("{}-{:%Y%m%d-%H%M%S}", file.stem().string(), fmt::localtime(std::time(nullptr)));
  fs::path folder = fs::path("runs") / name;
  for (int i = 2; fs::exists(folder); ++i) folder = fs::path("runs") / fmt::format("{}-{}", name, i);
  return folder;
}

void print_run_summary(const RunResult& result, const fs::path& folder) {
  std::size_t of_status[4] = {};
  for (const auto& node : result.nodes) ++of_status[static_cast<std::size_t>(node.status)];
  const auto number = [&](NodeStatus status) { return of_status[static_cast<std::size_t>(status)]; };
  std::string text = counted(number(NodeStatus::ok), "node") + " done";
  if (const auto hits = std::count_if(result.nodes.begin(), result.nodes.end(),
                                      [](const auto& n) { return n.is_hit() && n.status == NodeStatus::ok; });
      hits > 0)
    text += fmt::format(" ({} by the cache)", hits);
  for (const auto status : {NodeStatus::failed, NodeStatus::skipped, NodeStatus::cancelled})
    if (number(status) > 0) text += fmt::format(", {} {}", number(status), name_of(status));
  say("{} in {:.2f} s ({}, at most {} MB); see {}\n", text, result.wall, counted(result.threads, "thread"),
      result.peak_memory / 1'000'000, folder.string());
}

int run_file(const RunArguments& options) {
  limit_openmp(options.run.threads);
  Registry registry;
  const LoadResult loaded = load_pipeline(options.file, to_overrides(options.settings), registry);
  print_findings(loaded);
  if (!loaded.errors.empty()) return invalid;
  const CancelOnSignal signals;
  const fs::path out = options.out.empty() ? new_folder(options.file) : fs::path(options.out);
  const auto cache = open_cache(options.run);
  auto run = run_options<RunOptions>(options.run, cache.get(), out);
  run.cancel = signals.flag();
  const RunResult result = [&] {
    const StandardOutputSetAside results_only;
    ConsoleProgress progress(console_options(stderr, options.run.quiet));
    return run_pipeline(loaded.pipeline, run, progress);
  }();
  if (!options.run.quiet) {
    for (const auto& problem : result.cache_problems) say("warning: {}\n", problem);
    print_run_summary(result, out);
  }
  if (options.run.json)
    fmt::print("{}", results_json(loaded.pipeline, result, fs::absolute(out)));
  else if (has_stdout())
    fmt::print("{}", results_table(loaded.pipeline, result));
  if (!result.failures.empty()) return failed;
  return result.cancelled ? signals.exit_code() : ok;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* verb =
      app.add_subcommand("run", "Runs a pipeline: results on stdout, files and a record of the run in a folder.");
  const auto options = std::make_shared<RunArguments>();
  add_pipeline(*verb, options->file, options->settings);
  verb->add_option("--out", options->out, "the run's folder (default: runs/NAME-TIME)")->type_name("DIR");
  add_run_options(*verb, options->run);
  verb->callback([options, &exit_code] { exit_code = run_file(*options); });
}

}  // namespace atrium::cli
