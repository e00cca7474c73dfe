// atrium sweep plan|run FILE: many variants of a pipeline as one graph.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/api/standard_streams.hpp"
#include "graph/cache/build_ids.hpp"
#include "graph/cache/upkeep.hpp"
#include "graph/cli/signals.hpp"
#include "graph/cli/sweep_output.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"
#include "graph/run/console_progress.hpp"
#include "graph/sweep/forecast.hpp"
#include "graph/sweep/run.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

struct SweepArguments {
  std::string file;
  std::vector<std::string> settings;
  std::string out, memory;
  RunChoice run;
  std::int64_t max_failures = 0;
  bool fail_fast = false, isolate = false;
  double timeout = 0;
};

fs::path folder_of(const SweepArguments& options) {
  return options.out.empty() ? fs::path("runs") / fs::path(options.file).stem() : fs::path(options.out);
}

void print_notes(const SweepPlan& plan) {
  for (const auto& note : plan.notes) say("note: {}\n", note);
  if (plan.excluded > 0) say("note: {} excluded\n", counted(plan.excluded, "combination"));
}

/// "4 of 12 (2.3 s)": the nodes that are to be run.
std::string shown(const SweepForecast::Variant& variant) {
  if (variant.to_run == 0) return fmt::format("0 of {}", variant.cached);
  const std::string time = variant.unknown == variant.to_run
                               ? ""
                               : fmt::format(" ({}{:.3g} s)", variant.unknown > 0 ? "> " : "", variant.seconds);
  return fmt::format("{} of {}{}", variant.to_run, variant.cached + variant.to_run, time);
}

void print_forecast(const SweepForecast& forecast, const SweepPlan& plan, std::size_t done) {
  std::string text = fmt::format("{}, {} done; {} in all, ", counted(plan.variants.size(), "variant"), done,
                                 counted(plan.nodes, "node"));
  text +=
      fmt::format("{} once shared: {} cached, {} to run", node_count(plan.merged), forecast.cached, forecast.to_run);
  if (forecast.to_run > forecast.unknown) {
    text += fmt::format(", about {} one after the other", clock_text(forecast.seconds));
    text += fmt::format(", the largest with {}", size_text(forecast.memory));
    if (forecast.unknown > 0) text += fmt::format(" ({} nodes without an estimate are not counted)", forecast.unknown);
  }
  say("{}\n", text);
}

void print_plan_json(const SweepForecast& forecast, const SweepPlan& plan, const SweepFile& sweep,
                     const std::vector<bool>& done) {
  auto variants = nlohmann::ordered_json::array();
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    const auto& cost = forecast.variants[v];
    variants.push_back({{"id", plan.variants[v].id},
                        {"variant", label_of(sweep, plan.variants[v])},
                        {"done", static_cast<bool>(done[v])},
                        {"nodes_known", cost.cached},
                        {"nodes_to_run", cost.to_run},
                        {"nodes_of_unknown_cost", cost.unknown},
                        {"seconds", cost.seconds}});
  }
  const nlohmann::ordered_json json{{"variants", std::move(variants)},
                                    {"nodes", plan.nodes},
                                    {"merged_nodes", node_count(plan.merged)},
                                    {"nodes_known", forecast.cached},
                                    {"nodes_to_run", forecast.to_run},
                                    {"nodes_of_unknown_cost", forecast.unknown},
                                    {"seconds", forecast.seconds},
                                    {"memory", forecast.memory},
                                    {"excluded", plan.excluded},
                                    {"duplicates", plan.duplicates}};
  fmt::print("{}\n", json_text(json, 2));
}

int plan(const SweepArguments& options) {
  Registry registry;
  const LoadedSweep loaded = load_sweep(options.file, to_overrides(options.settings), registry);
  if (!loaded.sweep) return invalid;
  const SweepPlan& plan = loaded.load.plan;
  const fs::path variants = fs::absolute(folder_of(options)) / "variants";
  std::vector<bool> done(plan.variants.size(), false);
  if (fs::exists(variants)) {
    const std::string build = build_of_all(registry);
    for (std::size_t v = 0; v < done.size(); ++v)
      done[v] = reusable_result(variants / plan.variants[v].id, plan, plan.variants[v], build).has_value();
  }
  const auto cache = open_cache(options.run);
  const SweepForecast cost = forecast(plan, done, cache.get());
  print_notes(plan);
  if (options.run.json) {
    print_plan_json(cost, plan, *loaded.sweep, done);
    return ok;
  }
  Table table{{{"id"}, {"variant"}, {"done"}, {"to run"}}, {}};
  for (std::size_t v = 0; v < done.size(); ++v)
    table.rows.push_back({plan.variants[v].id, label_of(*loaded.sweep, plan.variants[v]), done[v] ? "yes" : "",
                          done[v] ? "" : shown(cost.variants[v])});
  fmt::print("{}", as_text(table));
  std::fflush(stdout);  // before what goes to stderr, where both are the same file
  print_forecast(cost, plan, static_cast<std::size_t>(std::count(done.begin(), done.end(), true)));
  return ok;
}

int run_variants(const SweepArguments& options) {
  limit_openmp(options.run.threads);
  Registry registry;
  const LoadedSweep loaded = load_sweep(options.file, to_overrides(options.settings), registry);
  if (!loaded.sweep) return invalid;
  const CancelOnSignal signals;
  const auto cache = open_cache(options.run);
  auto sweep_options = run_options<SweepOptions>(options.run, cache.get(), folder_of(options));
  sweep_options.cancel = signals.flag();
  if (!options.memory.empty()) sweep_options.memory = read_size(options.memory);
  if (options.max_failures > 0) sweep_options.max_failures = static_cast<std::size_t>(options.max_failures);
  if (options.fail_fast) sweep_options.max_failures = 1;
  if (options.isolate)
    sweep_options.isolation = {own_program(), worker_arguments(options.run, cache.get()), options.timeout};
  const bool quiet = options.run.quiet;
  if (!quiet) print_notes(loaded.load.plan);
  const SweepResult result = [&] {
    const StandardOutputSetAside results_only;
    ConsoleProgress progress(console_options(stderr, quiet));
    return run_sweep(*loaded.sweep, loaded.load.plan, build_of_all(registry), sweep_options, progress);
  }();
  if (signals.flag()->load()) {
    if (!quiet) print_summary(result, sweep_options.out);
    print_sweep(*loaded.sweep, loaded.load.plan, result, options.run.json);
    return signals.exit_code();
  }
  return finish_sweep(loaded, result, registry, sweep_options, options.run.json, quiet);
}

void add_common(CLI::App& verb, SweepArguments& options) {
  add_sweep_file(verb, options.file, options.settings);
  verb.add_option("--out", options.out, "the sweep's folder (default: runs/NAME); what is done in it is not done again")
      ->type_name("DIR");
}

}  // namespace

void add_sweep(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("sweep", "Runs many variants of a pipeline; what they share is run once.");
  verb->require_subcommand(1);
  const auto options = std::make_shared<SweepArguments>();
  auto* planned = verb->add_subcommand("plan", "Checks all variants and lists them, with what is done already.");
  add_common(*planned, *options);
  planned->add_flag("--json", options->run.json, "results as JSON on stdout");
  add_cache_options(*planned, options->run.cache);
  planned->callback([options, &exit_code] { exit_code = plan(*options); });
  auto* ran = verb->add_subcommand("run", "Runs the variants that are not done; prints their table.");
  add_common(*ran, *options);
  add_run_options(*ran, options->run);
  ran->add_option("--max-fail", options->max_failures, "stop after so many failed variants")
      ->check(CLI::Range(1, 1'000'000));
  ran->add_flag("--fail-fast", options->fail_fast, "stop after the first failure");
  ran->add_flag(
      "--isolate", options->isolate,
      "run each variant in a process of its own: a crash costs that variant only; what a process prints goes to "
      "variants/ID/worker.log");
  add_size(*ran, "--mem", options->memory, "with --isolate: memory that all processes together may hold, e.g. '8 GB'")
      ->needs("--isolate");
  add_timeout(*ran, options->timeout, "with --isolate: seconds after which a variant is ended; 0: none")
      ->needs("--isolate");
  ran->callback([options, &exit_code] { exit_code = run_variants(*options); });
  add_sweep_submit(*verb, exit_code);
  add_sweep_gather(*verb, exit_code);
  add_sweep_work(*verb, exit_code);
}

}  // namespace atrium::cli
