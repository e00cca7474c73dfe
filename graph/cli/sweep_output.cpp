#include "graph/cli/sweep_output.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/pipeline/find_pipeline.hpp"
#include "graph/sweep/sheets.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

void print(const std::vector<Diagnostic>& findings) {
  for (const auto& finding : findings) say("{}\n", to_string(finding));
}

}  // namespace

LoadedSweep load_sweep(const std::string& file, const std::vector<Override>& settings, Registry& registry) {
  LoadedSweep loaded;
  Findings findings;
  const GivenPipeline found = find_given_pipeline(file, findings);
  if (findings.error_count() == 0) loaded.sweep = read_sweep(found.path, found.name, findings);
  if (findings.error_count() == 0) loaded.load = plan_sweep(*loaded.sweep, settings, registry);
  print(findings.warnings());
  print(findings.errors());
  print(loaded.load.warnings);
  print(loaded.load.errors);
  if (findings.error_count() > 0 || !loaded.load.errors.empty()) loaded.sweep.reset();
  return loaded;
}

int print_sweep(const SweepFile& sweep, const SweepPlan& plan, const SweepResult& result, bool json) {
  if (json) {
    fmt::print("{}\n", json_text(table_json(sweep, plan, result.variants), 2));
  } else if (has_stdout()) {
    fmt::print("{}", as_text(short_table(sweep, plan, result.variants)));
  }
  std::vector<std::string> unknown;
  full_table(sweep, plan, result.variants, &unknown);
  for (const auto& problem : unknown)
    say("atrium: error: {}\n  help: the names are in variants/*/result.json\n", problem);
  std::size_t failures = 0;
  std::size_t cancelled = 0;
  for (const auto& variant : result.variants) {
    const bool bad = variant.status == VariantStatus::failed || variant.status == VariantStatus::crashed;
    failures += bad ? 1 : 0;
    cancelled += !bad && variant.status != VariantStatus::ok ? 1 : 0;
  }
  if (!unknown.empty()) return failed;
  if (failures == 0 && cancelled == 0) return ok;
  return failures == result.variants.size() ? failed : some_failed;
}

void print_summary(const SweepResult& result, const fs::path& folder) {
  std::map<VariantStatus, std::size_t> count;
  std::size_t reused = 0;
  for (const auto& variant : result.variants) {
    ++count[variant.status];
    reused += variant.reused ? 1 : 0;
  }
  std::string text = counted(count[VariantStatus::ok], "variant") + " done";
  if (reused > 0) text += fmt::format(" ({} before)", reused);
  for (const auto& [status, number] : count)
    if (status != VariantStatus::ok) text += fmt::format(", {} {}", number, name_of(status));
  if (result.cached > 0) text += fmt::format("; {} of {} by the cache", result.cached, counted(result.nodes, "node"));
  say("{} in {:.2f} s; see {}\n", text, result.wall, folder.string());
}

int finish_sweep(const LoadedSweep& loaded, const SweepResult& result, Registry& registry, const SweepOptions& options,
                 bool json, bool quiet) {
  const auto problems = write_sheets(*loaded.sweep, loaded.load.plan, result.variants, registry, options);
  for (const auto& problem : problems) say("atrium: error: {}\n", problem);
  for (const auto& problem : result.cache_problems)
    if (!quiet) say("warning: {}\n", problem);
  if (!quiet) print_summary(result, options.out);
  const int code = print_sweep(*loaded.sweep, loaded.load.plan, result, json);
  return code == ok && !problems.empty() ? failed : code;
}

}  // namespace atrium::cli
