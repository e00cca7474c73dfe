// atrium sweep plan|run FILE: many variants of a pipeline as one graph.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/cli/signals.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"
#include "graph/run/console_progress.hpp"
#include "graph/sweep/run.hpp"
#include "graph/sweep/sheets.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file;
  std::vector<std::string> settings;
  std::string out;
  int threads = 0;
  std::int64_t max_failures = 0;
  bool fail_fast = false, quiet = false, json = false, no_hashes = false;
};

struct Loaded {
  std::unique_ptr<SweepFile> sweep;
  SweepLoad load;
};

void print(const std::vector<Diagnostic>& findings) {
  for (const auto& finding : findings) fmt::print(stderr, "{}\n", to_string(finding));
}

/// Null sweep: it is invalid, and that has been said.
Loaded load(const Options& options, Registry& registry) {
  Loaded loaded;
  Findings findings;
  std::error_code ignored;
  const fs::path path = fs::absolute(options.file, ignored).lexically_normal();
  loaded.sweep = read_sweep(path, options.file, findings);
  if (findings.error_count() == 0) loaded.load = plan_sweep(*loaded.sweep, to_overrides(options.settings), registry);
  print(findings.warnings());
  print(findings.errors());
  print(loaded.load.warnings);
  print(loaded.load.errors);
  if (findings.error_count() > 0 || !loaded.load.errors.empty()) loaded.sweep.reset();
  return loaded;
}

fs::path folder_of(const Options& options) {
  return options.out.empty() ? fs::path("runs") / fs::path(options.file).stem() : fs::path(options.out);
}

void print_notes(const SweepPlan& plan) {
  for (const auto& note : plan.notes) fmt::print(stderr, "note: {}\n", note);
  if (plan.excluded > 0) fmt::print(stderr, "note: {} excluded\n", counted(plan.excluded, "combination"));
}

int plan(const Options& options) {
  Registry registry;
  const Loaded loaded = load(options, registry);
  if (!loaded.sweep) return invalid;
  const SweepPlan& plan = loaded.load.plan;
  const std::string build = registry.build();
  std::size_t done = 0;
  Table table{{{"id"}, {"variant"}, {"done"}}, {}};
  for (const auto& variant : plan.variants) {
    const bool known =
        reusable_result(fs::absolute(folder_of(options)) / "variants" / variant.id, plan, variant, build).has_value();
    done += known ? 1 : 0;
    table.rows.push_back({variant.id, label_of(*loaded.sweep, variant), known ? "yes" : ""});
  }
  print_notes(plan);
  if (options.json) {
    auto variants = nlohmann::ordered_json::array();
    for (const auto& row : table.rows)
      variants.push_back({{"id", row[0]}, {"variant", row[1]}, {"done", !row[2].empty()}});
    const nlohmann::ordered_json json{{"variants", std::move(variants)},
                                      {"nodes", plan.nodes},
                                      {"merged_nodes", plan.merged.nodes.size()},
                                      {"excluded", plan.excluded},
                                      {"duplicates", plan.duplicates}};
    fmt::print("{}\n", json.dump(2));
    return ok;
  }
  fmt::print("{}", as_text(table));
  fmt::print(stderr, "{}, {} done; {} of which {} are run, the others are shared\n",
             counted(plan.variants.size(), "variant"), done, counted(plan.nodes, "node"), plan.merged.nodes.size());
  return ok;
}

/// What the metrics' table shows, and whether a metric's name was wrong.
int print_results(const Options& options, const SweepFile& sweep, const SweepPlan& plan, const SweepResult& result) {
  if (options.json) {
    auto variants = nlohmann::ordered_json::array();
    const Table table = full_table(sweep, plan, result.variants);
    for (const auto& row : table.rows) {
      nlohmann::ordered_json json;
      for (std::size_t c = 0; c < row.size(); ++c) json[table.columns[c].title] = row[c];
      variants.push_back(std::move(json));
    }
    fmt::print("{}\n", nlohmann::ordered_json{{"variants", std::move(variants)}}.dump(
                           2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}", as_text(short_table(sweep, plan, result.variants)));
  }
  std::vector<std::string> unknown;
  full_table(sweep, plan, result.variants, &unknown);
  for (const auto& problem : unknown)
    fmt::print(stderr, "atrium: error: {}\n  help: the names are in variants/*/result.json\n", problem);
  std::size_t failures = 0;
  std::size_t cancelled = 0;
  for (const auto& variant : result.variants) {
    failures += variant.status == NodeStatus::failed ? 1 : 0;
    cancelled += variant.status == NodeStatus::cancelled ? 1 : 0;
  }
  if (!unknown.empty()) return failed;
  if (failures == 0 && cancelled == 0) return ok;
  return failures == result.variants.size() ? failed : some_failed;
}

void print_summary(const SweepResult& result, const fs::path& folder) {
  std::size_t count[4] = {};
  std::size_t reused = 0;
  for (const auto& variant : result.variants) {
    ++count[static_cast<std::size_t>(variant.status)];
    reused += variant.reused ? 1 : 0;
  }
  std::string text = counted(count[static_cast<std::size_t>(NodeStatus::ok)], "variant") + " done";
  if (reused > 0) text += fmt::format(" ({} before)", reused);
  for (const auto status : {NodeStatus::failed, NodeStatus::cancelled})
    if (count[static_cast<std::size_t>(status)] > 0)
      text += fmt::format(", {} {}", count[static_cast<std::size_t>(status)], name_of(status));
  fmt::print(stderr, "{} in {:.2f} s; see {}\n", text, result.wall, folder.string());
}

int run(const Options& options) {
  if (options.threads > 0)
    ::setenv("OMP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
  Registry registry;
  const Loaded loaded = load(options, registry);
  if (!loaded.sweep) return invalid;
  const CancelOnSignal signals;
  SweepOptions sweep_options;
  sweep_options.out = folder_of(options);
  sweep_options.threads = options.threads;
  sweep_options.hashes = !options.no_hashes;
  sweep_options.cancel = signals.flag();
  if (options.max_failures > 0) sweep_options.max_failures = static_cast<std::size_t>(options.max_failures);
  if (options.fail_fast) sweep_options.max_failures = 1;
  SweepResult result;
  if (!options.quiet) print_notes(loaded.load.plan);
  try {
    ConsoleProgress progress(console_options(stderr, options.quiet));
    result = run_sweep(*loaded.sweep, loaded.load.plan, registry.build(), sweep_options, progress);
  } catch (const FolderError& error) {
    fmt::print(stderr, "atrium: error: {}\n", error.what());
    if (!error.help().empty()) fmt::print(stderr, "  help: {}\n", error.help());
    return usage;
  }
  const std::vector<std::string> problems =
      signals.flag()->load() ? std::vector<std::string>{}
                             : write_sheets(*loaded.sweep, loaded.load.plan, result.variants, registry, sweep_options);
  for (const auto& problem : problems) fmt::print(stderr, "atrium: error: {}\n", problem);
  if (!options.quiet) print_summary(result, sweep_options.out);
  const int code = print_results(options, *loaded.sweep, loaded.load.plan, result);
  if (signals.flag()->load()) return signals.exit_code();
  return code == ok && !problems.empty() ? failed : code;
}

void add_common(CLI::App& verb, Options& options) {
  verb.add_option("FILE", options.file, "the sweep file")->required();
  add_settings(verb, options.settings);
  verb.add_option("--out", options.out,
                  "the sweep's folder (default: runs/NAME); what is done in it is not done again");
  verb.add_flag("--json", options.json, "results as JSON on stdout");
}

}  // namespace

void add_sweep(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("sweep", "Runs many variants of a pipeline; what they share is run once.");
  verb->require_subcommand(1);
  const auto options = std::make_shared<Options>();
  auto* planned = verb->add_subcommand("plan", "Checks all variants and lists them, with what is done already.");
  add_common(*planned, *options);
  planned->callback([options, &exit_code] { exit_code = plan(*options); });
  auto* ran = verb->add_subcommand("run", "Runs the variants that are not done; prints their table.");
  add_common(*ran, *options);
  ran->add_option("-j,--threads", options->threads, "threads; 1: one node after the other (default: one per core)")
      ->check(CLI::Range(1, 1024));
  ran->add_option("--max-fail", options->max_failures, "end when so many variants have failed")
      ->check(CLI::Range(1, 1'000'000));
  ran->add_flag("--fail-fast", options->fail_fast, "end when a variant has failed");
  ran->add_flag("-q,--quiet", options->quiet, "no progress and no warnings on stderr, errors only");
  ran->add_flag("--no-hashes", options->no_hashes, "leave the content hashes of outputs out of manifest.json");
  ran->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace atrium::cli
