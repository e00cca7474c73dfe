// The scheduler's steps with a cache.
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "graph/api/clocks.hpp"
#include "graph/api/files.hpp"
#include "graph/api/text.hpp"
#include "graph/cache/costs.hpp"
#include "graph/run/node_host.hpp"
#include "graph/run/scheduler.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
using Decision = PlannedNode::Decision;

constexpr const char* help_for_drift =
    "it depends on more than its inputs, parameters and files, or a library that it uses has changed: its type may "
    "need "
    "`static constexpr bool cached = false`";

}  // namespace

void Scheduler::note_builds() {
  for (const std::size_t n : all_nodes(pipeline_)) {
    try {
      cache_->build_of(*pipeline_[n].type);
    } catch (const std::exception&) {  // it is said where the key is wanted
    }
  }
}

/// The files that nodes read, so that the plan need not: they may be large and many.
void Scheduler::hash_inputs() {
  std::set<std::filesystem::path> files;
  for (const std::size_t n : all_nodes(pipeline_))
    if (pipeline_[n].type->cached)
      for (auto& file : input_files(pipeline_[n])) files.insert(std::move(file));
  const std::vector<std::filesystem::path> list(files.begin(), files.end());
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) {
    if (stopping()) return;
    try {
      cache_->hash_ahead(list[i]);
    } catch (const std::exception&) {  // it is said where the key is wanted
    }
  });
}

/// After a round in which a node gave another value than its record said: what depends on it is open again.
void Scheduler::reopen_readers_of_new_values() {
  std::vector<char> is_open(states_.size(), 0);
  for (const std::size_t n : order_) {
    for (const auto& edge : edges_into(n, pipeline_)) {
      const std::size_t from = boost::source(edge, pipeline_);
      if (states_[from].has_new_values || is_open[from] != 0) is_open[n] = 1;
    }
    if (is_open[n] != 0 && states_[n].settled) reopen(n);
  }
  for (State& state : states_) state.has_new_values = false;
}

void Scheduler::reopen(std::size_t n) {
  State& state = states_[n];
  for (const auto& edge : edges_into(n, pipeline_))
    ++states_[boost::source(edge, pipeline_)].readers[pipeline_[edge].output];
  if (std::exchange(state.told, false)) progress_.reopened(result_.nodes[n].node);
  state.values.assign(state.values.size(), {});
  state.hashes.clear();
  state.found = {};
  state.kept.clear();
  state.settled = state.blocked = false;
  state.blocker = states_.size();
  result_.nodes[n] = NodeRecord(pipeline_[n]);
}

/// Whether a round has neither settled a node nor found out anything: another one would not either. It does not happen
/// as long as the cache's answers do not contradict each other.
bool Scheduler::stands_still() {
  std::size_t findings = 0;
  for (const State& state : states_)
    findings += std::size_t{state.unloadable} + std::size_t{state.unreplayable} + std::size_t{state.drifted};
  if (settled_ > 0 || std::exchange(findings_, findings) != findings) {
    findings_ = findings;
    return false;
  }
  for (const std::size_t n : all_nodes(pipeline_)) {
    if (states_[n].settled) continue;
    fail(n, "what it reads can neither be loaded from the cache nor made again", "run it with --no-cache");
    tell(n);
    states_[n].settled = true;
  }
  return true;
}

void Scheduler::plan_round() {
  CachePlanOptions options;
  options.done = [this](std::size_t n) { return states_[n].settled ? &states_[n].hashes : nullptr; };
  options.has_value = [this](std::size_t n, std::size_t output, const std::string& hash) {
    if (states_[n].values[output].data) return true;
    const FlatType* flat = pipeline_[n].type->outputs[output].flat;
    return flat != nullptr && !states_[n].unloadable && cache_->has_value(*flat, hash);
  };
  options.unusable = [this](std::size_t n) { return states_[n].unreplayable; };
  options.stop = [this] { return stopping(); };
  plan_ = plan_with_cache(pipeline_, order_, *cache_, options);
}

/// Whether all that the node reads is what it was planned for.
bool Scheduler::is_planned_for_what_is(std::size_t n) const {
  if (plan_[n].decision == Decision::open) return false;
  const auto edges = edges_into(n, pipeline_);
  return std::all_of(edges.begin(), edges.end(), [&](const DataflowEdge& edge) {
    const std::size_t from = boost::source(edge, pipeline_);
    return states_[from].hashes == plan_[from].hashes;
  });
}

/// Takes what the node did from its record. False: it is to run.
bool Scheduler::take_from_cache(std::size_t n) {
  PlannedNode& planned = plan_[n];
  CacheLookup& found = states_[n].found;
  if (is_planned_for_what_is(n)) {
    found = std::move(planned.found);  // nobody else looks at it
    // A node of the same key may have been run meanwhile.
    if (!found.record && !found.key.fields.empty() && !states_[n].unreplayable)
      found.record = cache_->find(pipeline_[n].type->type, found.key.hex());
  } else {
    std::vector<std::vector<std::string>> inputs;
    for (const auto& port : inputs_of(n, pipeline_)) {
      auto& list = inputs.emplace_back();
      for (const Source& source : port) list.push_back(states_[source.node].hashes.at(source.output));
    }
    found = look_up(pipeline_[n], inputs, *cache_);
  }
  CacheUse& use = result_.nodes[n].cache;
  if (!found.record) {
    use = {CacheUse::Result::miss, found.key.fields.empty() ? "" : found.key.hex(), found.why};
    return false;
  }
  const CacheRecord& record = *found.record;
  use = {CacheUse::Result::hit, record.key, {}, false, record.wall, record.cpu, record.peak_memory, record.made};
  bool again = planned.decision == Decision::again;
  for (std::size_t i = 0; i < record.outputs.size() && !again; ++i) {
    const FlatType* flat = pipeline_[n].type->outputs[i].flat;
    again = planned.needed[i] != 0 && (flat == nullptr || !cache_->has_value(*flat, record.outputs[i].hash));
  }
  use.again = again;
  if (again) return false;
  if (replay(n, record)) return true;
  states_[n].unreplayable = true;
  use = {CacheUse::Result::miss, record.key, "a file that it wrote is not kept any more"};
  found.record.reset();
  return false;
}

/// Does what the node did, without it. False: not all of its files are there any more.
bool Scheduler::replay(std::size_t n, const CacheRecord& found) {
  const PipelineNode& node = pipeline_[n];
  NodeRecord& record = result_.nodes[n];
  const double start = wall_seconds() - start_;
  const double cpu = thread_cpu_seconds();
  const PngStamp& stamp = options_.stamp ? options_.stamp(node) : picture_stamp_;
  NodeHost host(
      record.node, options_.out, node.folder, [this] { return cancelled(); }, stamp, progress_, nullptr);
  Context context(node.seed, std::shared_ptr<ContextHost>(std::shared_ptr<void>(), &host));
  try {
    for (const auto& file : found.files) {
      if (!place_inside(fs::absolute(host.output_folder()), file.path))
        throw Error(fmt::format("its record in the cache names a file outside of the run's folder: {}", file.path));
      const auto target = context.output(file.path);
      if (!cache_->restore(file, target)) return false;
      host.wrote(target);
    }
  } catch (const std::exception& error) {
    progress_.message(record.node, error.what(), true);
    return false;
  }
  progress_.started(record.node);
  for (const auto& warning : found.warnings) host.log(ContextHost::Level::warning, warning);
  host.finish(record);
  record.start = start;
  record.thread = tbb::this_task_arena::current_thread_index();
  record.outputs = found.outputs;
  record.status = NodeStatus::ok;
  record.wall = wall_seconds() - start_ - start;
  record.cpu = thread_cpu_seconds() - cpu;
  tell(n);
  progress_.described(record);
  settle(n, {});
  return true;
}

/// Loads the values that the node lacks. False: one cannot be had, the node is left for another round.
bool Scheduler::load_inputs(std::size_t n) {
  for (const auto& edge : edges_into(n, pipeline_)) {
    const Source from = source_of(edge, pipeline_);
    const PortInfo& port = pipeline_[from.node].type->outputs[from.output];
    State& state = states_[from.node];
    std::string hash;
    {
      const std::lock_guard lock(mutex_);
      if (state.values[from.output].data) continue;
      hash = state.hashes[from.output];
    }
    memory_watch_.disturb();  // nodes that run meanwhile do not need what is loaded here
    const auto data = port.flat == nullptr || hash.empty() ? nullptr : cache_->load(*port.flat, hash);
    memory_watch_.disturb();
    const std::lock_guard lock(mutex_);
    if (data) {
      if (!state.values[from.output].data) state.values[from.output] = port.wrap(data);
      continue;
    }
    state.unloadable = true;
    ++lost_;
    return false;
  }
  return true;
}

/// A node that was known and had to run for its values. If it gives something else now, its record is replaced by the
/// new one; what reads it has not been taken or run yet, and goes by what it is now. Returns what is to be said then.
std::string Scheduler::compare_with_record(std::size_t n) {
  const auto& found = states_[n].found;
  NodeRecord& record = result_.nodes[n];
  if (!found.record) return {};
  for (std::size_t i = 0; i < record.outputs.size(); ++i) {
    if (record.outputs[i].hash == found.record->outputs[i].hash) continue;
    cache_->forget(record.type, found.record->key);  // also if what it gives now cannot be kept
    record.cache = {CacheUse::Result::miss, found.record->key,
                    fmt::format("run again, it gave another '{}' than before", record.outputs[i].port)};
    return fmt::format("{}: what depends on it is computed anew ({})", record.cache.why, help_for_drift);
  }
  return {};
}

/// Runs a node that was done, for a value that could not be loaded. Nothing is told of it unless it fails or gives
/// something else than before.
void Scheduler::run_for_values(std::size_t n) {
  if (!load_inputs(n)) {
    std::vector<Value> garbage;
    const std::lock_guard lock(mutex_);
    release_inputs(n, garbage);
    return;
  }
  NodeRecord& record = result_.nodes[n];
  NodeRecord before = std::exchange(record, NodeRecord(pipeline_[n]));
  Inputs inputs;
  {
    const std::lock_guard lock(mutex_);
    inputs = values_for(n);
  }
  std::vector<Value> outputs;
  std::optional<std::uint64_t> growth;
  const bool ok = call_watched(n, std::move(inputs), outputs, growth) && note_facts(n, outputs);
  if (ok) describe(n, outputs);
  std::string changed;
  for (std::size_t i = 0; ok && i < outputs.size() && changed.empty(); ++i)
    if (record.outputs[i].hash != before.outputs[i].hash) changed = record.outputs[i].port;
  if (!ok && cancelled()) {
    record = std::move(before);
    settle(n, {});
    return;
  }
  if (ok && changed.empty()) {
    std::tie(before.wall, before.cpu, before.peak_memory) = std::tuple(record.wall, record.cpu, record.peak_memory);
    before.cache.again = true;
    record = std::move(before);
    settle(n, outputs);
    return;
  }
  cache_->forget(record.type, before.cache.key);
  if (ok && !std::exchange(states_[n].drifted, true)) {
    record.status = NodeStatus::ok;
    record.cache = {CacheUse::Result::miss, before.cache.key,
                    fmt::format("run again, it gave another '{}' than before", changed)};
    keep(n, outputs, growth);
    take_new_values(n, fmt::format("{}: what depends on it is done anew ({})", record.cache.why, help_for_drift));
    settle(n, outputs);
    return;
  }
  if (ok) fail(n, fmt::format("it gives another '{}' each time that it is run", changed), help_for_drift);
  tell(n);
  settle(n, {});
}

/// Others have used what the node gave before: another round sets them right.
void Scheduler::take_new_values(std::size_t n, const std::string& drift) {
  NodeRecord& record = result_.nodes[n];
  record.warnings.push_back(drift);
  progress_.message(record.node, drift, true);
  tell(n);
  progress_.described(record);
  const std::lock_guard lock(mutex_);
  State& state = states_[n];
  state.has_new_values = true;
  state.hashes.clear();
  for (const auto& output : record.outputs) state.hashes.push_back(output.hash);
  ++lost_;
}

double Scheduler::cost_of_inputs(std::size_t n) const {
  double cost = 0;
  for (const auto& edge : edges_into(n, pipeline_)) cost += states_[boost::source(edge, pipeline_)].cost;
  return cost;
}

void Scheduler::keep(std::size_t n, const std::vector<Value>& outputs, std::optional<std::uint64_t> growth) {
  const PipelineNode& node = pipeline_[n];
  const NodeRecord& done = result_.nodes[n];
  State& state = states_[n];
  const NodeKey& key = state.found.key;
  double cost = done.wall + cost_of_inputs(n);
  bool all = true;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    all = outputs[i].flat != nullptr && !done.outputs[i].hash.empty() &&
          cache_->keep_value(*outputs[i].flat, outputs[i].data, done.outputs[i].hash, done.outputs[i].bytes, cost) &&
          all;
  state.cost = all ? 0 : cost;
  if (key.fields.empty() || state.kept.size() != done.artefacts.size()) return;
  try {
    // A file has changed since its hash was taken: which of the two was read?
    std::vector<std::string> files;
    for (const auto& file : input_files(node)) files.push_back(FileHashes::fingerprint(file));
    if (files != state.found.files || !cache_->is_build_unchanged(*node.type)) return;
  } catch (const std::exception&) {
    return;
  }
  CacheRecord record{key.hex(), key.fields, address_of(node), utc_text()};
  for (const auto& output : done.outputs)
    if (output.hash.empty()) return;
  record.outputs = done.outputs;
  record.warnings = done.warnings;
  record.files = state.kept;
  record.wall = done.wall;
  record.cpu = done.cpu;
  record.peak_memory = done.peak_memory;
  record.growth = growth;
  cache_->keep(record);
}

}  // namespace atrium
