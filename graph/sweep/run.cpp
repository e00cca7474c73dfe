#include "graph/sweep/run.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "graph/cache/costs.hpp"
#include "graph/run/clocks.hpp"
#include "graph/run/manifest.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/run/scheduler.hpp"
#include "graph/run/trace.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

/// What the sweep is of, for programs that read its folder: axes with the labels of their choices in order, and what
/// each sets; metrics with the digits that they are shown with.
std::string sweep_json(const SweepFile& sweep) {
  using Json = nlohmann::ordered_json;
  Json json{{"atrium", framework_version()}, {"sweep", sweep.path.string()}, {"base", sweep.base.string()}};
  if (!sweep.summary.empty()) json["summary"] = sweep.summary;
  json["axes"] = Json::array();
  for (const auto& axis : sweep.axes) {
    Json choices = Json::array();
    for (const auto& choice : axis.choices) {
      Json set = Json::object();
      for (const auto& setting : choice.settings) set[setting.target] = setting.value;
      choices.push_back({{"label", choice.label}, {"set", std::move(set)}});
    }
    json["axes"].push_back({{"name", axis.name}, {"choices", std::move(choices)}});
  }
  json["metrics"] = Json::array();
  for (const auto& metric : sweep.metrics) {
    Json shown{{"name", metric.name}};
    if (metric.digits) shown["digits"] = *metric.digits;
    json["metrics"].push_back(std::move(shown));
  }
  json["pictures"] = Json::array();
  for (const auto& sheet : sweep.sheets) json["pictures"].push_back({{"file", sheet.file}, {"picture", sheet.picture}});
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The sweep's folder, locked against a second run at the same time. Refused if it holds anything but a sweep.
class SweepFolder {
 public:
  SweepFolder(const fs::path& folder, const SweepFile& sweep) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw FolderError("cannot make the folder " + folder.string() + ": " + error.message());
    if (!fs::exists(folder / sweep_mark) && !holds_only_unfinished(folder))
      throw FolderError(folder.string() + " is not empty and is not the folder of a sweep",
                        "choose another folder with --out, or empty it");
    lock_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0) {
      write_file(folder / sweep_mark, sweep_json(sweep));
      return;
    }
    if (lock_ >= 0) ::close(lock_);
    throw FolderError("another sweep is writing into " + folder.string(), "choose another folder with --out");
  }
  ~SweepFolder() { ::close(lock_); }
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;

 private:
  int lock_ = -1;
};

/// Gathers what the nodes of the merged graph report, and records each variant when its last node is done.
class Recorder final : public ProgressSink {
 public:
  Recorder(const SweepFile& sweep, const SweepPlan& plan, const std::string& build, const SweepOptions& options,
           ProgressSink& progress)
      : sweep_(sweep), plan_(plan), build_(build), options_(options), progress_(progress) {
    variants_.resize(plan.variants.size());
    left_.assign(plan.variants.size(), 0);
    records_.resize(plan.merged.nodes.size());
    for (std::size_t n = 0; n < plan.merged.nodes.size(); ++n) index_.emplace(plan.merged.nodes[n].path, n);
  }

  /// The nodes of the variants that are not done yet.
  std::vector<bool> prepare() {
    std::vector<bool> wanted(plan_.merged.nodes.size(), false);
    variants_of_.resize(plan_.merged.nodes.size());
    for (std::size_t v = 0; v < plan_.variants.size(); ++v) {
      const SweepVariant& variant = plan_.variants[v];
      const fs::path folder = folder_of(variant);
      if (auto known = reusable_result(folder, plan_, variant, build_)) {
        variants_[v] = std::move(*known);
        continue;
      }
      std::error_code ignored;
      fs::remove_all(folder, ignored);
      fs::create_directories(folder, ignored);
      write_file(folder / "resolved.yaml", resolved_yaml(variant_pipeline(sweep_, plan_, variant)), false);
      left_[v] = variant.nodes.size();
      for (const std::size_t n : variant.nodes) {
        wanted[n] = true;
        variants_of_[n].push_back(v);
      }
    }
    return wanted;
  }

  void planned(std::size_t nodes) override { progress_.planned(nodes); }
  void started(const std::string& node) override { progress_.started(node); }
  void progress(const std::string& node, double share) override { progress_.progress(node, share); }
  void message(const std::string& node, std::string_view text, bool warning) override {
    progress_.message(node, text, warning);
  }
  void finished(const NodeRecord& record) override {
    progress_.finished(record);
    if (record.status != NodeStatus::ok) settle(record);
  }
  void described(const NodeRecord& record) override { settle(record); }

  /// A picture shows a variant: the first that has the node which drew it.
  const PngStamp& stamp_of_variant(const PipelineNode& node) {
    const std::lock_guard lock(mutex_);
    const auto [known, fresh] = stamps_.try_emplace(node.folder.filename().string());
    if (fresh)
      for (const auto& variant : plan_.variants)
        if (variant.id == known->first) known->second = stamp_of(variant_pipeline(sweep_, plan_, variant));
    return known->second;
  }

  const std::atomic<bool>* stop() const { return &stop_; }
  std::vector<VariantResult> take() { return std::move(variants_); }
  const std::vector<NodeRecord>& records() const { return records_; }

 private:
  void settle(const NodeRecord& record) {
    const std::lock_guard lock(mutex_);
    const std::size_t n = index_.at(record.node);
    records_[n] = record;
    for (const std::size_t v : variants_of_[n])
      if (--left_[v] == 0) record_variant(v);
  }

  fs::path folder_of(const SweepVariant& variant) const { return options_.out / "variants" / variant.id; }

  std::string path_of(std::size_t n) const {
    const std::string& path = plan_.merged.nodes[n].path;
    return path.substr(path.find('/') + 1);
  }

  void record_variant(std::size_t v) {
    const SweepVariant& variant = plan_.variants[v];
    VariantResult& result = variants_[v];
    result.status = NodeStatus::ok;
    for (const std::size_t n : variant.nodes) add_node(variant, n, result);
    for (const auto& output : variant.outputs) {
      const NodeRecord& record = records_[output.from.node];
      if (record.status == NodeStatus::ok && !record.facts[output.from.output].empty())
        result.outputs.push_back({output.name, record.facts[output.from.output]});
    }
    if (result.status == NodeStatus::failed && ++failures_ >= options_.max_failures) stop_ = true;
    if (result.status == NodeStatus::cancelled) return;  // it is done anew next time
    write_file(folder_of(variant) / "result.json",
               result_json(folder_of(variant), sweep_, plan_, variant, result, build_),
               false);  // if it is cut off, the variant is not done
  }

  void add_node(const SweepVariant& variant, std::size_t n, VariantResult& result) {
    const NodeRecord& record = records_[n];
    result.nodes.push_back({path_of(n), record.type, record.status, record.computing_wall(), record.computing_cpu(),
                            record.computing_memory(), record.outputs});
    if (record.status == NodeStatus::failed && result.message.empty())
      result.message = path_of(n) + ": " + record.message;
    if (record.status == NodeStatus::failed) result.status = NodeStatus::failed;
    if (record.status == NodeStatus::skipped && result.status == NodeStatus::ok) {
      // Its own nodes are all right: one of them was to be run again for a value, and that failed.
      result.status = NodeStatus::failed;
      result.message = path_of(n) + ": " + record.because + " failed";
    }
    if (record.status == NodeStatus::cancelled && result.status == NodeStatus::ok)
      result.status = NodeStatus::cancelled;
    for (const auto& artefact : record.artefacts) add_artefact(variant, n, artefact, result);
  }

  /// A file that another variant's node wrote for both is linked, so that each variant's folder is complete.
  void add_artefact(const SweepVariant& variant, std::size_t n, const Artefact& artefact, VariantResult& result) {
    const fs::path folder = plan_.merged.nodes[n].folder;
    const fs::path relative = fs::path(artefact.path).lexically_relative(folder);
    result.artefacts.push_back({relative.generic_string(), artefact.bytes});
    const fs::path target = folder_of(variant) / relative;
    const fs::path source = options_.out / artefact.path;
    std::error_code error;
    if (source == target || fs::exists(target, error)) return;
    fs::create_directories(target.parent_path(), error);
    fs::create_hard_link(source, target, error);
    if (error) fs::copy_file(source, target, error);
  }

  const SweepFile& sweep_;
  const SweepPlan& plan_;
  const std::string& build_;
  const SweepOptions& options_;
  ProgressSink& progress_;
  std::mutex mutex_;
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<std::vector<std::size_t>> variants_of_;
  std::vector<std::size_t> left_;
  std::vector<NodeRecord> records_;
  std::vector<VariantResult> variants_;
  std::map<std::string, PngStamp> stamps_;  ///< by variant
  std::atomic<std::size_t> failures_ = 0;
  std::atomic<bool> stop_ = false;
};

/// The merged graph without the nodes that are not wanted.
Pipeline part_of(const Pipeline& merged, const std::vector<bool>& wanted) {
  Pipeline pipeline;
  pipeline.summary = merged.summary;
  pipeline.file = merged.file;
  std::vector<std::size_t> place(merged.nodes.size(), 0);
  for (std::size_t n = 0; n < merged.nodes.size(); ++n) {
    if (!wanted[n]) continue;
    place[n] = pipeline.nodes.size();
    PipelineNode node = merged.nodes[n];
    for (auto& port : node.inputs)
      for (auto& edge : port) edge.node = place[edge.node];
    pipeline.nodes.push_back(std::move(node));
  }
  return pipeline;
}

}  // namespace

SweepResult run_sweep(const SweepFile& sweep, const SweepPlan& plan, const std::string& build,
                      const SweepOptions& given, ProgressSink& progress) {
  SweepOptions options = given;
  options.out = fs::absolute(given.out).lexically_normal();
  const SweepFolder folder(options.out, sweep);
  const std::string started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  Recorder recorder(sweep, plan, build, options, progress);
  const Pipeline pipeline = part_of(plan.merged, recorder.prepare());
  SweepResult result;
  if (!pipeline.nodes.empty()) {
    RunOptions run_options;
    run_options.out = options.out;
    run_options.threads = options.threads;
    run_options.hashes = options.hashes;
    run_options.cancel = options.cancel;
    run_options.stop = recorder.stop();
    run_options.cache = options.cache;
    Costs costs(options.cache == nullptr ? CachePlaces{} : options.cache->places());
    run_options.memory = options.memory;
    if (options.cache != nullptr)
      run_options.memory_of = [&](const PipelineNode& node) -> std::optional<std::uint64_t> {
        const auto cost = costs.of(node.type->type, address_of(node));
        return cost ? std::optional(cost->memory) : std::nullopt;
      };
    run_options.stamp = [&](const PipelineNode& node) -> const PngStamp& { return recorder.stamp_of_variant(node); };
    const double start = wall_seconds();
    const double cpu = process_cpu_seconds();
    RunResult run = Scheduler(pipeline, run_options, recorder).run();
    finish_cache(options.cache, run);
    run.wall = result.wall = wall_seconds() - start;
    run.cpu = process_cpu_seconds() - cpu;
    run.peak_memory = peak_memory();
    for (const auto& node : run.nodes) run.peak_memory = std::max(run.peak_memory, node.peak_memory);
    result.peak_memory = run.peak_memory;
    result.cancelled = run.cancelled;
    result.nodes = run.nodes.size();
    for (const auto& node : run.nodes) result.known += node.is_hit() ? 1 : 0;
    result.cache_problems = run.cache_problems;
    write_file(options.out / "trace.json", trace_json(run));
    write_file(options.out / "manifest.json", manifest_json(pipeline, run, started));
  }
  result.variants = recorder.take();
  write_file(options.out / "table.csv", as_csv(full_table(sweep, plan, result.variants)));
  const Table table = short_table(sweep, plan, result.variants);
  write_file(options.out / "table.md", as_markdown(table));
  write_file(options.out / "table.txt", as_text(table));
  return result;
}

}  // namespace atrium
