// The scheduler's steps with a cache: what is known already, and what must be there for what is not.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <ctime>

#include "graph/cache/costs.hpp"
#include "graph/run/clocks.hpp"
#include "graph/run/node_host.hpp"
#include "graph/run/scheduler.hpp"

namespace atrium {
namespace {

std::vector<std::string> fingerprints_of(const PipelineNode& node) {
  std::vector<std::string> result;
  for (const auto& file : input_files(node)) result.push_back(FileHashes::fingerprint(file));
  return result;
}

/// Whether the record is of a node with these outputs.
bool fits(const CacheRecord& record, const NodeType& type) {
  if (record.outputs.size() != type.outputs.size()) return false;
  for (std::size_t i = 0; i < type.outputs.size(); ++i)
    if (record.outputs[i].port != type.outputs[i].name || record.outputs[i].type != type.outputs[i].type) return false;
  return true;
}

}  // namespace

void Scheduler::note_builds() {
  for (const auto& node : pipeline_.nodes) {
    try {
      cache_->build_of(*node.type);
    } catch (const Error&) {  // it is said where the key is wanted
    }
  }
}

void Scheduler::look(std::size_t n) {
  if (find_key(n)) {
    CacheUse& use = result_.nodes[n].cache;
    const std::string& type = pipeline_.nodes[n].type->type;
    const auto found = cache_->find(type, use.key);
    if (found && fits(*found, *pipeline_.nodes[n].type)) {
      if (replay(n, *found)) return;
      use.why = "a file that it wrote is not kept any more";
    } else {
      use.why = "not computed before";
    }
  }
  std::size_t tasks = 0;
  std::optional<std::size_t> lost;
  {
    const std::lock_guard lock(mutex_);
    lost = lost_producer(n);
    if (!lost) tasks = demand(n);
  }
  spawn_(tasks);
  if (lost) drop_waiters(*lost);
}

/// The node's key, unless it has none: then why not.
bool Scheduler::find_key(std::size_t n) {
  const PipelineNode& node = pipeline_.nodes[n];
  CacheUse& use = result_.nodes[n].cache;
  use.result = CacheUse::Result::miss;
  if (!node.type->cached) {
    use.why = "nodes of this type are run every time";
    return false;
  }
  std::vector<std::vector<std::string>> hashes;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& port : node.inputs) {
      auto& list = hashes.emplace_back();
      for (const Edge& edge : port) list.push_back(states_[edge.node].hashes.at(edge.output));
    }
  }
  for (const auto& list : hashes)
    for (const auto& hash : list)
      if (hash.empty()) {
        use.why = "an input could not be hashed";
        return false;
      }
  try {
    State& state = states_[n];
    state.files = fingerprints_of(node);
    state.key = cache_->key_of(node, hashes);
    use.key = state.key.hex();
    return true;
  } catch (const std::exception& error) {
    use.why = error.what();
    return false;
  }
}

/// Does what the node did, without it. False: not all of its files are there any more.
bool Scheduler::replay(std::size_t n, const CacheRecord& found) {
  const PipelineNode& node = pipeline_.nodes[n];
  NodeRecord& record = result_.nodes[n];
  const double start = wall_seconds() - start_;
  const double cpu = thread_cpu_seconds();
  const PngStamp& stamp = options_.stamp ? options_.stamp(node) : picture_stamp_;
  NodeHost host(record.node, options_.out, node.folder, options_.cancel, stamp, progress_, nullptr);
  Context context(node.seed, std::shared_ptr<ContextHost>(std::shared_ptr<void>(), &host));
  try {
    for (const auto& file : found.files) {
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
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.outputs.size(); ++i) {
    const auto& output = found.outputs[i];
    record.outputs.push_back({output.port, output.type, output.bytes, output.hash});
    record.facts.push_back(output.facts);
    const FlatType* flat = node.type->outputs[i].flat;
    kept += flat != nullptr && cache_->has_value(*flat, output.hash) ? 1 : 0;
  }
  states_[n].cost = kept == found.outputs.size() ? 0 : found.wall + cost_of_inputs(n);
  record.cache = {CacheUse::Result::hit, found.key, {}, false, found.wall, found.cpu, found.peak_memory, found.made};
  record.status = NodeStatus::ok;
  record.wall = wall_seconds() - start_ - start;
  record.cpu = thread_cpu_seconds() - cpu;
  progress_.finished(record);
  settle_with_cache(n, {});
  return true;
}

/// As soon as a node is settled, another thread may run it again, for its values, and write its record: what is told of
/// it is what it was before.
void Scheduler::settle_with_cache(std::size_t n, const std::vector<Value>& outputs) {
  const NodeRecord done = result_.nodes[n];
  settle(n, outputs);
  if (done.status == NodeStatus::ok) progress_.described(done);
}

/// A node whose value the node needs and that cannot be made again, if there is one: then the node waits for it, to be
/// dropped with its other waiters.
std::optional<std::size_t> Scheduler::lost_producer(std::size_t n) {
  for (const auto& port : pipeline_.nodes[n].inputs)
    for (const Edge& edge : port) {
      State& from = states_[edge.node];
      if (from.values[edge.output].data || result_.nodes[edge.node].status != NodeStatus::failed) continue;
      from.waiters.push_back(n);
      return edge.node;
    }
  return std::nullopt;
}

/// Queues what the node needs before it can run, or the node itself.
std::size_t Scheduler::demand(std::size_t n) {
  std::size_t tasks = 0;
  for (const auto& port : pipeline_.nodes[n].inputs) {
    for (const Edge& edge : port) {
      State& from = states_[edge.node];
      if (from.values[edge.output].data) continue;
      from.wanted[edge.output] = 1;
      if (from.waiters.empty() || from.waiters.back() != n) {
        from.waiters.push_back(n);
        ++states_[n].lacking;
      }
      if (std::exchange(from.under_way, true)) continue;
      push(edge.node, Step::fetch);
      ++tasks;
    }
  }
  if (states_[n].lacking > 0) return tasks;
  push(n, Step::run);
  return tasks + 1;
}

/// Loads the values that are wanted of a node; if one cannot be had, the node is run again.
void Scheduler::fetch(std::size_t p) {
  std::size_t tasks = 0;
  std::optional<std::size_t> lost;
  while (true) {
    std::size_t output = 0;
    {
      const std::lock_guard lock(mutex_);
      const State& state = states_[p];
      while (output < state.wanted.size() && (state.wanted[output] == 0 || state.values[output].data)) ++output;
      if (output == state.wanted.size()) {
        tasks = wake(p);
        break;
      }
    }
    const PortInfo& port = pipeline_.nodes[p].type->outputs[output];
    memory_watch_.disturb();  // nodes that run meanwhile do not need what is loaded here
    const auto data = port.flat == nullptr ? nullptr : cache_->load(*port.flat, states_[p].hashes[output]);
    memory_watch_.disturb();
    const std::lock_guard lock(mutex_);
    if (data) {
      states_[p].values[output] = port.wrap(data);
      continue;
    }
    result_.nodes[p].cache.again = true;
    for (const auto& edges : pipeline_.nodes[p].inputs)
      for (const Edge& edge : edges) ++plan_.readers[edge.node][edge.output];
    lost = lost_producer(p);
    if (!lost) tasks = demand(p);
    break;
  }
  spawn_(tasks);
  if (lost) drop_waiters(*lost);
}

/// Nothing is lacking of a node any more.
std::size_t Scheduler::wake(std::size_t p) {
  std::size_t tasks = 0;
  for (const std::size_t waiter : take_waiters(p))
    if (--states_[waiter].lacking == 0) {
      push(waiter, Step::run);
      ++tasks;
    }
  return tasks;
}

/// Nobody waits for the node's values any more.
std::vector<std::size_t> Scheduler::take_waiters(std::size_t p) {
  State& state = states_[p];
  state.under_way = false;
  std::fill(state.wanted.begin(), state.wanted.end(), 0);
  return std::exchange(state.waiters, {});
}

/// After a node was run that had been done by its record alone.
void Scheduler::settle_again(std::size_t n, const std::vector<Value>& outputs) {
  std::vector<Value> garbage;
  std::size_t started = 0;
  {
    const std::lock_guard lock(mutex_);
    keep_outputs(n, outputs);
    release_inputs(n, garbage);
    if (!outputs.empty()) started = wake(n);
  }
  spawn_(started);
  if (outputs.empty()) drop_waiters(n);
}

/// What waits for the values of a node that will not give them cannot run either.
void Scheduler::drop_waiters(std::size_t n) {
  std::vector<Value> garbage;
  std::vector<std::size_t> passed;
  std::size_t started = 0;
  {
    const std::lock_guard lock(mutex_);
    std::vector<std::size_t> stack{n};
    while (!stack.empty()) {
      const std::size_t by = stack.back();
      stack.pop_back();
      for (const std::size_t waiter : take_waiters(by)) {
        State& state = states_[waiter];
        if (!state.settled) {
          block(waiter, by);
          state.blocked = true;
          pass_over(waiter, garbage);
          passed.push_back(waiter);
        } else if (!state.blocked) {  // it was to run again, too
          lose(waiter, by);
          release_inputs(waiter, garbage);
          stack.push_back(waiter);
        }  // else another node that it waited for was lost before
      }
    }
    for (std::size_t i = 0, direct = passed.size(); i < direct; ++i)
      started += release_followers(passed[i], garbage, passed);
  }
  spawn_(started);
  for (const std::size_t p : passed) progress_.finished(result_.nodes[p]);
}

/// The value of a node that was to run again cannot be had, because that of `by` cannot.
void Scheduler::lose(std::size_t n, std::size_t by) {
  NodeRecord& record = result_.nodes[n];
  if (result_.nodes[by].status != NodeStatus::failed || record.status == NodeStatus::failed) return;
  record.status = NodeStatus::failed;
  record.message = "its value is not kept and cannot be made again: '" + result_.nodes[by].node + "' failed";
}

/// The run is ending: a step that was queued is not made.
void Scheduler::abandon(std::size_t n) {
  bool again = false;
  {
    const std::lock_guard lock(mutex_);
    again = states_[n].settled;
  }
  if (again) {
    drop_waiters(n);
    return;
  }
  progress_.finished(result_.nodes[n]);
  settle(n, {});
}

/// A node that was run again must give what its record says: the keys of other nodes depend on it.
bool Scheduler::hashes_are_right(std::size_t n) {
  const auto& outputs = result_.nodes[n].outputs;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].hash == states_[n].hashes[i]) continue;
    fail(n, fmt::format("run again, it gave another '{}' than before", outputs[i].port),
         "it depends on more than its inputs, parameters and files: its type needs `static constexpr bool cached = "
         "false`; --no-cache runs the pipeline as it is");
    return false;
  }
  return true;
}

double Scheduler::cost_of_inputs(std::size_t n) {
  const std::lock_guard lock(mutex_);
  double cost = 0;
  for (const auto& port : pipeline_.nodes[n].inputs)
    for (const Edge& edge : port) cost += states_[edge.node].cost;
  return cost;
}

void Scheduler::keep(std::size_t n, const std::vector<Value>& outputs, std::optional<std::uint64_t> growth) {
  const PipelineNode& node = pipeline_.nodes[n];
  const NodeRecord& done = result_.nodes[n];
  const State& state = states_[n];
  double cost = done.wall + cost_of_inputs(n);
  bool all = true;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    all = outputs[i].flat != nullptr && !done.outputs[i].hash.empty() &&
          cache_->keep_value(*outputs[i].flat, outputs[i].data, done.outputs[i].hash, done.outputs[i].bytes, cost) &&
          all;
  {
    const std::lock_guard lock(mutex_);
    states_[n].cost = all ? 0 : cost;
  }
  if (state.key.fields.empty() || state.kept.size() != done.artefacts.size()) return;
  try {
    // A file has changed since its hash was taken: which of the two was read?
    if (fingerprints_of(node) != state.files || !cache_->is_build_unchanged(*node.type)) return;
  } catch (const std::exception&) {
    return;
  }
  CacheRecord record{done.cache.key, state.key.fields, address_of(node),
                     fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputRecord& output = done.outputs[i];
    if (output.hash.empty()) return;
    record.outputs.push_back({output.port, output.type, output.bytes, output.hash, done.facts[i]});
  }
  record.warnings = done.warnings;
  record.files = state.kept;
  record.wall = done.wall;
  record.cpu = done.cpu;
  record.peak_memory = done.peak_memory;
  record.growth = growth;
  cache_->keep(record);
}

}  // namespace atrium
