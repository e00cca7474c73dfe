// atrium sweep submit|gather: a sweep on many machines, by an engine that users have.
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>

#include "graph/api/supervised_process.hpp"
#include "graph/cache/build_ids.hpp"
#include "graph/cache/upkeep.hpp"
#include "graph/cli/sweep_output.hpp"
#include "graph/farm/submission.hpp"
#include "graph/sweep/recorder.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

struct SubmitArguments {
  std::string file, out, memory;
  RunChoice run;
  SubmitOptions submit;
  Submission submission;
};

void check_engine(const std::string& engine) {
  try {
    program_file(engine == "slurm" ? "sbatch" : "parallel");
  } catch (const Error& missing) {
    throw Error(missing.what(), fmt::format("apt-get install {}; or look at it with --dry-run",
                                            engine == "slurm" ? "slurm-client" : "parallel"));
  }
}

/// How many of the submitted variants have left a result.
std::size_t results_in(const fs::path& out, const SweepPlan& plan, const std::string& build) {
  return static_cast<std::size_t>(std::count_if(
      plan.variants.begin(), plan.variants.end(),
      [&](const SweepVariant& variant) { return read_result(variant_folder(out, variant), build).has_value(); }));
}

/// Hands the scripts to the engine, and says what came of it.
int run_scripts(const SubmitArguments& options, const SweepPlan& plan, const Submission& submission,
                const SubmitScripts& scripts, const fs::path& out) {
  const std::size_t before = results_in(out, plan, submission.build);
  const int status = run_program({"/bin/sh", scripts.submit_file.string()});
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  // GNU parallel returns how many jobs failed: it is for `gather` to say what became of the variants.
  if (code != 0 && (options.submission.engine == "slurm" || code > 101)) {
    say("atrium: error: {} ended with exit code {}\n", scripts.submit_file.string(), code);
    return failed;
  }
  if (options.submission.engine == "slurm") {
    say("{} submitted; their table: atrium sweep gather {}\n", counted(scripts.variants, "variant"), options.out);
    return ok;
  }
  const std::size_t all = plan.variants.size();
  const std::size_t done = results_in(out, plan, submission.build);
  say("{} of {} have a result; their table: atrium sweep gather {}\n", done, counted(all, "variant"), options.out);
  if (done < all) say("  help: what the others printed is in {}/*.log\n", scripts.submit_file.parent_path().string());
  return done < before + scripts.variants ? failed : ok;
}

int submit(const SubmitArguments& options) {
  Registry registry;
  Submission submission = options.submission;
  SubmitOptions submit = options.submit;
  const LoadedSweep loaded = load_sweep(options.file, to_overrides(submission.settings), registry);
  if (!loaded.sweep) return invalid;
  if (!submit.dry) check_engine(submission.engine);
  const auto cache = open_cache(options.run);
  submit.out = fs::absolute(options.out).lexically_normal();
  submit.program = own_program();
  submit.cache = cache.get();
  submission.sweep = loaded.sweep->path;
  submission.folder = fs::current_path();
  submission.build = build_of_all(registry);
  submission.arguments = worker_arguments(options.run, cache.get());
  if (cache) submission.cache = cache->places().folder.string();
  if (!options.memory.empty()) submission.memory = read_size(options.memory);
  const SubmitScripts scripts = prepare_submission(*loaded.sweep, loaded.load.plan, submission, submit);
  if (scripts.variants == 0) {
    say("all variants are done already: `atrium sweep run` prints their table\n");
    return ok;
  }
  if (submit.dry) {
    fmt::print("# {}\n{}\n", scripts.job_file.string(), scripts.job);
    fmt::print("# {}\n{}", scripts.submit_file.string(), scripts.submit);
    return ok;
  }
  return run_scripts(options, loaded.load.plan, submission, scripts, submit.out);
}

int gather(const SubmitArguments& options) {
  const fs::path out = fs::absolute(options.out).lexically_normal();
  const Submission submission = read_submission(out);
  Registry registry;
  auto settings = to_overrides(submission.settings);
  for (auto& setting : settings) setting.folder = submission.folder;
  const LoadedSweep loaded = load_sweep(submission.sweep.string(), settings, registry);
  if (!loaded.sweep) return invalid;
  const SweepResult result = atrium::gather(out, submission, *loaded.sweep, loaded.load.plan);
  SweepOptions sweep_options;
  sweep_options.out = out;
  return finish_sweep(loaded, result, registry, sweep_options, options.run.json, options.run.quiet);
}

}  // namespace

void add_sweep_submit(CLI::App& sweep, int& exit_code) {
  auto* verb = sweep.add_subcommand("submit",
                                    "Hands the variants that are not done to Slurm or GNU parallel, what several share "
                                    "first; see share/doc/farm.md.");
  const auto options = std::make_shared<SubmitArguments>();
  add_sweep_file(*verb, options->file, options->submission.settings);
  verb->add_option("ENGINE_OPTIONS", options->submit.engine_options,
                   "after --, passed on to sbatch or parallel: -- --partition=long --time=2:00:00");
  verb->add_option("--out", options->out, "the sweep's folder, on a file system that all machines have")
      ->required()
      ->type_name("DIR");
  verb->add_option("--engine", options->submission.engine,
                   "slurm: two job arrays (sbatch); parallel: GNU parallel, here or with --sshlogin")
      ->required()
      ->check(CLI::IsMember({"slurm", "parallel"}));
  verb->add_option("--shards", options->submit.shards, "number of jobs (default: one per variant, at most 100)")
      ->check(CLI::Range(1, 100'000));
  verb->add_flag("--dry-run", options->submit.dry, "only print what would be called");
  add_threads(*verb, options->submit.threads, "threads of each shard (default: what Slurm gives it; with parallel 1)");
  add_size(*verb, "--mem", options->memory, "memory that a shard may hold: 8 GB; a variant that needs more is ended");
  add_timeout(*verb, options->submission.timeout, "seconds after which a variant is ended; 0: none");
  verb->add_flag("--no-hashes", options->run.no_hashes, "leave out the content hashes of outputs");
  add_cache_options(*verb, options->run.cache);
  verb->callback([options, &exit_code] { exit_code = submit(*options); });
}

void add_sweep_gather(CLI::App& sweep, int& exit_code) {
  auto* verb = sweep.add_subcommand(
      "gather", "Joins what the shards of `submit` have left so far, as `run` would have left it; prints the table.");
  const auto options = std::make_shared<SubmitArguments>();
  verb->add_option("DIR", options->out, "the sweep's folder")->required();
  verb->add_flag("-q,--quiet", options->run.quiet, "errors only on stderr");
  verb->add_flag("--json", options->run.json, "results as JSON on stdout");
  verb->callback([options, &exit_code] { exit_code = gather(*options); });
}

}  // namespace atrium::cli
