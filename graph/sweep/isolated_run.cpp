#include "graph/sweep/isolated_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/cache/costs.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/sweep/merge.hpp"
#include "graph/sweep/recorder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr std::size_t most_cached_in_one = 50;             // variants that the cache has whole, in one process
constexpr std::uint64_t memory_of_a_process = 50'000'000;  // besides what its nodes need

std::vector<std::size_t> not_done(const std::vector<bool>& wanted) {
  std::vector<std::size_t> list;
  for (std::size_t v = 0; v < wanted.size(); ++v)
    if (wanted[v]) list.push_back(v);
  return list;
}

std::vector<bool> inverted(std::vector<bool> list) {
  list.flip();
  return list;
}

bool writes_files(const NodeType& type) {
  return std::any_of(type.params.begin(), type.params.end(),
                     [](const ParamInfo& param) { return param.kind == ParamKind::output_path; });
}

}  // namespace

VariantNote note_of(const SweepPlan& plan, const SweepVariant& variant, VariantName name) {
  VariantNote note{std::move(name), {}};
  for (const std::size_t n : variant.nodes) {
    const PipelineNode& node = plan.merged[n];
    const std::string owner = node.folder.filename().string();
    if (owner != variant.id && writes_files(*node.type)) note.stamps.emplace_back(address_in_variant(node), owner);
  }
  return note;
}

IsolatedRun::IsolatedRun(const SweepPlan& plan, std::vector<bool> wanted, IsolateOptions options, JoinedRun& joined)
    : plan_(plan),
      wanted_(std::move(wanted)),
      options_(std::move(options)),
      joined_(joined),
      forecast_(atrium::forecast(plan, inverted(wanted_), options_.cache)),
      costs_(options_.cache == nullptr ? CachePlaces{} : options_.cache->places()),
      results_(plan.variants.size()) {}

PoolOptions IsolatedRun::pool_options() const {
  return {options_.threads, options_.memory, options_.isolation->timeout, options_.cancel, &stop_};
}

std::vector<std::string> IsolatedRun::command(const std::vector<std::string>& names, int threads) const {
  std::vector<std::string> command{options_.isolation->program, "sweep", "work", options_.out.string()};
  command.insert(command.end(), names.begin(), names.end());
  command.insert(command.end(), {"--here", "--build", options_.build, "-j", std::to_string(threads)});
  const auto& more = options_.isolation->arguments;
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

void IsolatedRun::hear(const std::string& process, std::size_t lane, const Json& event) {
  if (event.value("e", "") == "end") learned_ = std::max(learned_, event.at("peak_memory").get<std::uint64_t>());
  joined_.hear(process, lane, event);
  if (options_.journal) options_.journal(process, event);
}

/// What the largest of the nodes that are to be run will probably need; nothing: not known, and no worker has ended
/// yet.
std::optional<std::uint64_t> IsolatedRun::memory_of(const std::vector<std::size_t>& nodes) {
  std::uint64_t most = 0;
  for (const std::size_t n : nodes) {
    if (forecast_.nodes[n] == SweepForecast::Node::cached) continue;
    const auto cost = costs_.of(plan_.merged[n].type->type, address_in_variant(plan_.merged[n]));
    if (!cost || !cost->memory) return learned_ > 0 ? std::optional(learned_) : std::nullopt;
    most = std::max(most, *cost->memory);
  }
  return most + memory_of_a_process;
}

void IsolatedRun::run_shared(const std::vector<std::pair<std::string, WorkerTask>>& tasks) {
  std::vector<std::vector<std::string>> skipped(tasks.size());
  WorkerPool* pool_pointer = nullptr;
  const auto add = [&](std::size_t t) {
    PoolTask task;
    task.id = t;
    task.timed_by_node = true;
    task.command = [&, t](int threads) {
      auto words = command({tasks[t].first}, threads);
      for (const auto& node : skipped[t]) words.insert(words.end(), {"--skip", node});
      return words;
    };
    task.memory = [this] { return learned_ > 0 ? std::optional(learned_) : std::nullopt; };
    pool_pointer->add(std::move(task));
  };
  const auto on_end = [&](const PoolTask& task, const PoolEnd& end) {
    if (end.how != PoolEnd::How::crashed || end.nodes.empty()) return;
    skipped[task.id].insert(skipped[task.id].end(), end.nodes.begin(), end.nodes.end());
    add(task.id);
  };
  WorkerPool pool(
      pool_options(), [&](const PoolTask& task, const Json& event) { hear(tasks[task.id].first, task.place, event); },
      on_end);
  pool.on_tick = options_.on_tick;
  pool_pointer = &pool;
  for (std::size_t t = 0; t < tasks.size(); ++t) add(t);
  pool.run();
}

void IsolatedRun::run_variants() {
  WorkerPool* pool_pointer = nullptr;
  const auto process = [&](const PoolTask& task) { return plan_.variants[groups_[task.id].front()].id; };
  WorkerPool pool(
      pool_options(), [&](const PoolTask& task, const Json& event) { hear(process(task), task.place, event); },
      [&](const PoolTask& task, const PoolEnd& end) {
        const std::vector<std::size_t> variants = groups_[task.id];
        ended(*pool_pointer, variants, end);
      });
  pool.on_tick = options_.on_tick;
  pool_pointer = &pool;
  std::vector<std::size_t> cached;
  for (const std::size_t v : not_done(wanted_)) {
    if (options_.cache == nullptr || forecast_.variants[v].to_run > 0) continue;
    cached.push_back(v);
    if (cached.size() == most_cached_in_one) add_variants(pool, std::exchange(cached, {}));
  }
  if (!cached.empty()) add_variants(pool, std::move(cached));
  for (const std::size_t v : not_done(wanted_))
    if (options_.cache == nullptr || forecast_.variants[v].to_run > 0) add_variants(pool, {v});
  pool.run();
}

void IsolatedRun::add_variants(WorkerPool& pool, std::vector<std::size_t> variants) {
  PoolTask task;
  task.id = groups_.size();
  task.timed_by_node = variants.size() > 1;
  std::vector<std::string> ids;
  ids.reserve(variants.size());
  for (const std::size_t v : variants) ids.push_back(plan_.variants[v].id);
  task.command = [this, ids](int threads) { return command(ids, threads); };
  task.memory = [this, v = variants.front()] { return memory_of(plan_.variants[v].nodes); };
  groups_.push_back(std::move(variants));
  pool.add(std::move(task));
}

/// Variants of a process that crashed are tried one by one if they were several.
void IsolatedRun::ended(WorkerPool& pool, const std::vector<std::size_t>& variants, const PoolEnd& end) {
  for (const std::size_t v : variants) {
    const fs::path folder = variant_folder(options_.out, plan_.variants[v]);
    if (auto result = read_result(folder, options_.build)) {
      results_[v] = std::move(*result);
      failures_ += results_[v].status == VariantStatus::failed ? 1 : 0;
    } else if (variants.size() > 1 && end.how == PoolEnd::How::crashed) {
      add_variants(pool, {v});
      continue;
    } else if (end.how != PoolEnd::How::cancelled) {
      settle(v, end);
    }
    if (variants.size() == 1 && !end.printed.empty()) write_file(folder / worker_log, end.printed, false);
    if (options_.journal)
      options_.journal(plan_.variants[v].id,
                       {{"e", "variant"}, {"id", plan_.variants[v].id}, {"status", name_of(results_[v].status)}});
  }
  if (failures_ >= options_.max_failures) stop_ = true;
}

/// A variant that left no result: its process crashed, or it was cancelled.
void IsolatedRun::settle(std::size_t v, const PoolEnd& end) {
  const SweepVariant& variant = plan_.variants[v];
  if (end.how == PoolEnd::How::done) return;  // cancelled
  for (const auto& node : end.nodes)
    hear(variant.id, 0, {{"e", "crashed"}, {"node", node}, {"message", "crashed: " + end.reason}});
  std::vector<NodeRecord> records(node_count(plan_.merged));
  for (const std::size_t n : variant.nodes) {
    const PipelineNode& node = plan_.merged[n];
    const NodeRecord* told = joined_.record_of(variant.id + "/" + address_in_variant(node));
    records[n] = told != nullptr ? *told : NodeRecord(node);
    if (told == nullptr) mark_skipped(plan_.merged, n, records);
  }
  VariantResult result = result_of(plan_, variant, [&](std::size_t n) -> const NodeRecord& { return records[n]; });
  result.status = VariantStatus::crashed;
  result.message = end.message;
  ++failures_;
  for (const std::size_t n : variant.nodes)
    for (const auto& file : records[n].artefacts)
      result.artefacts.push_back(
          {fs::path(file.path).lexically_relative(fs::path("variants") / variant.id).generic_string(), file.bytes});
  write_result(variant_folder(options_.out, variant), options_.name(variant), plan_, variant, result, options_.build,
               state_of_inputs(plan_, variant));
  results_[v] = std::move(result);
}

}  // namespace atrium
