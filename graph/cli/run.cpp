// atrium run FILE: runs a pipeline into a folder. Progress on stderr, results on stdout.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>

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
  int threads = 0;
  bool quiet = false, json = false, no_hashes = false;
  CacheChoice cache;
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
  limit_openmp(options.threads);
  Registry registry;
  const LoadResult loaded = load_pipeline(options.file, to_overrides(options.settings), registry);
  print_findings(loaded);
  if (!loaded.errors.empty()) return invalid;
  const CancelOnSignal signals;
  RunOptions run_options;
  run_options.out = options.out.empty() ? new_folder(options.file) : fs::path(options.out);
  run_options.threads = options.threads;
  run_options.hashes = !options.no_hashes;
  run_options.cancel = signals.flag();
  const auto cache = open_cache(options.cache);
  run_options.cache = cache.get();
  RunResult result;
  try {
    ConsoleProgress progress(console_options(stderr, options.quiet));
    result = run_pipeline(loaded.pipeline, run_options, progress);
  } catch (const FolderError& error) {
    print_error(error.what(), error.help());
    return usage;
  }
  for (const auto& problem : result.cache_problems)
    if (!options.quiet) say("warning: {}\n", problem);
  if (!options.quiet) print_run_summary(result, run_options.out);
  if (options.json)
    fmt::print("{}", results_json(loaded.pipeline, result, fs::absolute(run_options.out)));
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
  verb->add_option("FILE", options->file,
                   "the pipeline file, the name of an installed one, or a picture that a run has made (PNG)")
      ->required()
      ->type_name("");
  add_settings(*verb, options->settings);
  verb->add_option("--out", options->out, "the run's folder (default: runs/NAME-TIME)")->type_name("DIR");
  verb->add_option("-j,--threads", options->threads, "threads; 1: one node after the other (default: one per core)")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("-q,--quiet", options->quiet, "no progress and no warnings on stderr, errors only");
  verb->add_flag("--json", options->json, "results as JSON on stdout");
  verb->add_flag("--no-hashes", options->no_hashes, "leave the content hashes of outputs out of manifest.json");
  add_cache_options(*verb, options->cache);
  verb->callback([options, &exit_code] { exit_code = run_file(*options); });
}

}  // namespace atrium::cli
