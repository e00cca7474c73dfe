#include "graph/sweep/run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <thread>

#include "graph/api/clocks.hpp"
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
  RunOptions run_options;
  run_options.out = options.out;
  run_options.threads = options.threads;
  run_options.hashes = options.hashes;
  run_options.cancel = options.cancel;
  run_options.stop = recorder.stop();
  run_options.cache = options.cache;
  run_options.stamp = [&](const PipelineNode& node) -> const PngStamp& { return recorder.stamp_of_variant(node); };
  const double cpu = process_cpu_seconds();
  RunResult run = Scheduler(pipeline, run_options, recorder).run();
  finish_cache(options.cache, run);
  run.cpu = process_cpu_seconds() - cpu;
  run.peak_memory = peak_memory();
  for (const auto& node : run.nodes) run.peak_memory = std::max(run.peak_memory, node.peak_memory);
  return run;
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
  IsolateOptions isolate{options.out,
                         options.isolation->program,
                         options.isolation->arguments,
                         build,
                         options.threads,
                         options.memory,
                         options.isolation->timeout,
                         options.max_failures,
                         options.cancel,
                         options.cache,
                         name,
                         {},
                         {}};
  // Without a cache what variants share goes through one that is gone afterwards.
  if (options.cache == nullptr) {
    const auto use = {std::string("--cache"), (work / "cache").string()};
    isolate.arguments.insert(isolate.arguments.end(), use.begin(), use.end());
  }
  IsolatedRun isolated(plan, wanted, isolate, joined);
  std::vector<std::pair<std::string, WorkerTask>> shared;
  for (auto& task : shared_beginnings(plan, wanted, isolated.known())) {
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

}  // namespace

namespace {

/// A label as the name of a file.
std::string file_name_of(const std::string& label) {
  constexpr std::size_t longest = 120;
  std::string name;
  for (const char c : label) name += c == '/' || static_cast<unsigned char>(c) < 0x20 ? '_' : c;
  while (name.size() > longest ||
         (!name.empty() && (static_cast<unsigned char>(name.back()) & 0xC0U) == 0x80U && name.size() > longest - 4))
    name.pop_back();
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
  for (const auto& node : run.nodes) result.known += node.is_hit() ? 1 : 0;
  result.cache_problems = run.cache_problems;
  write_file(out / "trace.json", trace_json(run));
  write_file(out / "manifest.json", manifest_json(pipeline, run, started));
}

SweepResult run_sweep(const SweepFile& sweep, const SweepPlan& plan, const std::string& build,
                      const SweepOptions& given, ProgressSink& progress) {
  SweepOptions options = given;
  options.out = fs::absolute(given.out).lexically_normal();
  const SweepFolder folder(options.out, sweep);
  const std::string started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
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
