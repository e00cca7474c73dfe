#include "graph/sweep/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "graph/api/clocks.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/run/manifest.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/run/scheduler.hpp"
#include "graph/run/trace.hpp"
#include "graph/sweep/isolated_run.hpp"
#include "graph/sweep/merge.hpp"
#include "graph/sweep/recorder.hpp"
#include "graph/sweep/shared_beginnings.hpp"
#include "graph/sweep/sweep_folder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

/// All variants in this process, as one graph.
RunResult run_together(const Pipeline& pipeline, const SweepOptions& options, Recorder& recorder) {
  RunOptions run_options = options;
  run_options.stop = recorder.stop();
  run_options.stamp = [&](const PipelineNode& node) -> const PngStamp& { return recorder.stamp_of_variant(node); };
  return Scheduler(pipeline, run_options, recorder).run();
}

/// Each variant in a process of its own.
RunResult run_isolated(const SweepPlan& plan, const std::vector<bool>& wanted, const std::string& build,
                       const SweepOptions& options, const std::function<VariantName(const SweepVariant&)>& name,
                       ProgressSink& progress, std::vector<VariantResult>& results) {
  const fs::path work = options.out / farm_folder;
  std::error_code ignored;
  fs::remove_all(work, ignored);
  fs::create_directories(work, ignored);
  for (std::size_t v = 0; v < wanted.size(); ++v)
    if (wanted[v])
      write_note(variant_folder(options.out, plan.variants[v]),
                 note_of(plan, plan.variants[v], name(plan.variants[v])));
  JoinedRun joined(plan, wanted, epoch_seconds(), progress);
  IsolateOptions isolate{options, build, name};
  // Without a cache what variants share goes through one that is gone afterwards.
  if (options.cache == nullptr) {
    auto& arguments = isolate.isolation->arguments;
    arguments.insert(arguments.end(), {"--cache", (work / "cache").string()});
  }
  IsolatedRun isolated(plan, wanted, isolate, joined);
  std::vector<std::pair<std::string, WorkerTask>> shared;
  for (auto& task : shared_beginnings(plan, wanted, isolated.forecast().cached_nodes())) {
    shared.emplace_back(fmt::format("shared-{}", shared.size() + 1), std::move(task));
    write_file(work / shared.back().first, task_text(shared.back().second), false);
  }
  isolated.run_shared(shared);
  isolated.run_variants();
  for (std::size_t v = 0; v < wanted.size(); ++v)
    if (wanted[v]) results[v] = std::move(isolated.results()[v]);
  fs::remove_all(work, ignored);
  RunResult run = joined.run();
  run.threads = options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  if (options.cache != nullptr) run.cache_folder = options.cache->places().folder.string();
  return run;
}

/// A label as the name of a file, which systems limit to 255 bytes.
std::string file_name_of(const std::string& label) {
  constexpr std::size_t longest = 120, most_bytes = 240;
  std::string name = shortened(label, longest);
  while (name.size() > most_bytes) name = shortened(name, count_characters(name) - 1);
  for (char& c : name)
    if (c == '/' || static_cast<unsigned char>(c) < 0x20) c = '_';
  return name.starts_with('.') ? "_" + name : name;
}

/// OUT/by_label/LABEL leads to the variant's folder, whose name is its id.
void write_labels(const fs::path& out, const SweepFile& sweep, const SweepPlan& plan) {
  const fs::path folder = out / "by_label";
  std::error_code ignored;
  if (fs::is_symlink(folder, ignored)) return;  // somebody's own folder
  if (!fs::exists(folder, ignored)) fs::create_directories(folder, ignored);
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_symlink(ignored)) fs::remove(entry.path(), ignored);
  for (const auto& variant : plan.variants) {
    fs::path link = folder / file_name_of(caption_of(sweep, variant));
    if (fs::symlink_status(link, ignored).type() != fs::file_type::not_found) link += " " + variant.id;
    fs::create_directory_symlink(fs::path("..") / "variants" / variant.id, link, ignored);
  }
}

}  // namespace

void write_tables(const fs::path& out, const SweepFile& sweep, const SweepPlan& plan,
                  const std::vector<VariantResult>& results) {
  write_labels(out, sweep, plan);
  write_file(out / "table.csv", as_csv(full_table(sweep, plan, results)));
  write_file(out / "table.json", json_text(table_json(sweep, plan, results), 1) + "\n");
  const Table table = short_table(sweep, plan, results);
  write_file(out / "table.md", as_markdown(table));
  write_file(out / "table.txt", as_text(table));
}

void write_run(const fs::path& out, const Pipeline& pipeline, const RunResult& run, const std::string& started,
               SweepResult& result) {
  result.wall = run.wall;
  result.peak_memory = run.peak_memory;
  result.cancelled = run.cancelled;
  result.nodes = run.nodes.size();
  for (const auto& node : run.nodes) result.cached += node.is_hit() ? 1 : 0;
  result.cache_problems = run.cache_problems;
  write_file(out / "trace.json", trace_json(run));
  write_file(out / "manifest.json", manifest_json(pipeline, run, started));
}

SweepResult run_sweep(const SweepFile& sweep, const SweepPlan& plan, const std::string& build,
                      const SweepOptions& given, ProgressSink& progress) {
  SweepOptions options = given;
  options.out = fs::absolute(given.out).lexically_normal();
  const SweepFolder folder(options.out, sweep);
  const std::string started = utc_text();
  const auto name = [&](const SweepVariant& variant) { return name_of(sweep, variant); };
  SweepResult result;
  std::vector<bool> wanted;
  for (auto& done : done_variants(options.out, plan, build)) {
    wanted.push_back(!done);
    result.variants.push_back(done ? std::move(*done) : VariantResult{});
    if (wanted.back()) begin_variant(options.out, plan, plan.variants[wanted.size() - 1]);
  }
  const Pipeline pipeline = part_of(plan.merged, nodes_of(plan, wanted));
  if (node_count(pipeline) > 0) {
    const double start = wall_seconds();
    RunResult run;
    if (options.isolation) {
      run = run_isolated(plan, wanted, build, options, name, progress, result.variants);
    } else {
      Recorder recorder(plan, wanted, {options.out, build, options.max_failures, name}, progress);
      run = run_together(pipeline, options, recorder);
      for (std::size_t v = 0; v < wanted.size(); ++v)
        if (wanted[v]) result.variants[v] = std::move(recorder.results()[v]);
    }
    run.wall = wall_seconds() - start;
    write_run(options.out, pipeline, run, started, result);
  }
  write_tables(options.out, sweep, plan, result.variants);
  return result;
}

}  // namespace atrium
