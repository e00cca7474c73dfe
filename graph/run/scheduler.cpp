#include "graph/run/scheduler.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <new>
#include <tuple>

#include "graph/api/helper_memory.hpp"
#include "graph/run/clocks.hpp"
#include "graph/run/node_host.hpp"

namespace atrium {
namespace {

// Nodes shorter than this share the last reading of the process's peak memory: a reading takes about as long as a small
// node.
constexpr double peak_reading_interval = 1e-3;

}  // namespace

bool Scheduler::Ready::operator<(const Ready& other) const {
  return std::tuple(stamp, is_end, remaining, other.node) <
         std::tuple(other.stamp, other.is_end, other.remaining, node);
}

Scheduler::Scheduler(const Pipeline& pipeline, const RunOptions& options, ProgressSink& progress)
    : pipeline_(pipeline),
      options_(options),
      progress_(progress),
      cache_(options.cache),
      plan_(make_plan(pipeline)),
      picture_stamp_(stamp_of(pipeline)),
      admission_(options.memory, options.memory_of),
      states_(pipeline.nodes.size()) {
  result_.nodes.resize(pipeline.nodes.size());
  for (std::size_t n = 0; n < pipeline.nodes.size(); ++n) {
    result_.nodes[n].node = pipeline.nodes[n].path;
    result_.nodes[n].type = pipeline.nodes[n].type->type;
    states_[n].values.resize(pipeline.nodes[n].type->outputs.size());
    states_[n].wanted.resize(pipeline.nodes[n].type->outputs.size(), 0);
    states_[n].blocker = pipeline.nodes.size();
  }
}

RunResult Scheduler::run() {
  const int threads = options_.threads > 0 ? options_.threads : tbb::this_task_arena::max_concurrency();
  result_.threads = threads;
  start_ = wall_seconds();
  peak_memory_ = peak_memory();
  progress_.planned(pipeline_.nodes.size());
  if (cache_ != nullptr) note_builds();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads, 1);
  arena.execute([&] {
    tbb::task_group group;
    spawn_ = [&](std::size_t tasks) {
      for (std::size_t i = 0; i < tasks; ++i) group.run([this] { step(); });
    };
    for (std::size_t n = 0; n < pipeline_.nodes.size(); ++n)
      if (plan_.waits[n] == 0) push(n, cache_ == nullptr ? Step::run : Step::look);
    ++stamp_;
    spawn_(ready_.size());
    group.wait();
  });
  for (const auto& output : pipeline_.outputs) {
    const Value& value = states_[output.from.node].values[output.from.output];
    if (value.data) result_.outputs[output.name] = value;
  }
  for (const auto& node : result_.nodes) {
    if (node.status == NodeStatus::failed) result_.failures.push_back({node.node, node.type, node.message, node.help});
    result_.cancelled = result_.cancelled || node.status == NodeStatus::cancelled;
  }
  return std::move(result_);
}

bool Scheduler::cancelled() const { return options_.cancel != nullptr && options_.cancel->load(); }
bool Scheduler::stopping() const { return cancelled() || (options_.stop != nullptr && options_.stop->load()); }

void Scheduler::push(std::size_t n, Step step) {
  ready_.push({stamp_, n, plan_.followers[n].empty(), plan_.remaining[n], step});
}

void Scheduler::step() {
  Ready next{};
  {
    const std::lock_guard lock(mutex_);
    next = ready_.top();
    ready_.pop();
    if (next.step == Step::run && !stopping() && !admission_.admit(next.node, pipeline_.nodes[next.node])) return;
  }
  if (stopping())
    abandon(next.node);
  else if (next.step == Step::look)
    look(next.node);
  else if (next.step == Step::fetch)
    fetch(next.node);
  else
    execute(next.node);
}

void Scheduler::execute(std::size_t n) {
  NodeRecord& record = result_.nodes[n];
  Inputs inputs;
  bool again = false;
  {
    const std::lock_guard lock(mutex_);
    inputs = inputs_of(n);
    again = states_[n].settled;
  }
  if (!again) progress_.started(record.node);
  std::vector<Value> outputs;
  std::optional<std::uint64_t> growth;
  bool ok = call_watched(n, std::move(inputs), outputs, growth);
  if (ok) note_facts(n, outputs);
  if (ok && cache_ != nullptr) {  // the nodes that read the outputs need their hashes
    describe(n, outputs);
    ok = !again || hashes_are_right(n);
  }
  if (ok && !again) record.status = NodeStatus::ok;
  if (!ok) outputs.clear();
  // Before others start: whatever they do to the process, this is done.
  if (ok && cache_ != nullptr) keep(n, outputs, growth);
  if (again) {
    if (record.status == NodeStatus::failed) progress_.message(record.node, record.message, true);
    settle_again(n, outputs);
  } else {
    progress_.finished(record);
    if (cache_ == nullptr) {
      settle(n, outputs);
      if (ok) describe(n, outputs);
      if (ok) progress_.described(record);
    } else {
      settle_with_cache(n, outputs);
    }
  }
  if (options_.memory > 0) give_memory_back(n, growth);
}

/// call(), with what happens to the process's memory.
bool Scheduler::call_watched(std::size_t n, Inputs inputs, std::vector<Value>& outputs,
                             std::optional<std::uint64_t>& growth) {
  NodeRecord& record = result_.nodes[n];
  const bool watched = cache_ != nullptr || options_.memory > 0;
  if (result_.threads == 1 && !watched) reset_peak_memory();
  const std::size_t watch = watched ? memory_watch_.begin() : 0;
  take_helper_memory();
  const bool ok = call(n, inputs, outputs);
  const std::uint64_t helper_memory = take_helper_memory();
  inputs.clear();  // the last reference goes in settle
  if (watched) growth = memory_watch_.end(watch);
  if (growth) *growth += helper_memory;
  if (result_.threads == 1)
    peak_memory_ = peak_memory();
  else if (record.wall >= peak_reading_interval)
    peak_memory_ = std::max(memory_watch_.peak_before(), peak_memory());
  record.peak_memory = peak_memory_ + helper_memory;
  return ok;
}

void Scheduler::give_memory_back(std::size_t n, std::optional<std::uint64_t> growth) {
  std::size_t tasks = 0;
  {
    const std::lock_guard lock(mutex_);
    admission_.done(n, result_.nodes[n].type, growth);
    tasks = retry_refused();
  }
  spawn_(tasks);
}

/// Nodes that had to wait for memory.
std::size_t Scheduler::retry_refused() {
  const auto refused = admission_.later();
  for (const std::size_t n : refused) push(n, Step::run);
  return refused.size();
}

bool Scheduler::call(std::size_t n, const Inputs& inputs, std::vector<Value>& outputs) {
  const PipelineNode& node = pipeline_.nodes[n];
  NodeRecord& record = result_.nodes[n];
  const PngStamp& stamp = options_.stamp ? options_.stamp(node) : picture_stamp_;
  Cache* keeper = states_[n].key.fields.empty() ? nullptr : cache_;
  const auto host =
      std::make_shared<NodeHost>(record.node, options_.out, node.folder, options_.cancel, stamp, progress_, keeper);
  Context context(node.seed, host, node.type->random);
  record.thread = tbb::this_task_arena::current_thread_index();
  record.start = wall_seconds() - start_;
  const double cpu = thread_cpu_seconds();
  bool ok = false;
  try {
    // Isolated: a thread that waits in the node's loops must not start another node meanwhile.
    tbb::this_task_arena::isolate([&] { outputs = node.type->run(inputs, node.params, context); });
    ok = true;
  } catch (const Cancelled&) {
    if (!cancelled()) fail(n, "ended as if cancelled, but nobody cancelled the run", "");
  } catch (const Error& error) {
    fail(n, error.what(), error.help());
  } catch (const std::bad_alloc&) {
    fail(n, "out of memory", "give it fewer points (a coarser voxel grid, a crop), or run with -j 1");
  } catch (const std::exception& error) {
    fail(n, error.what(), "");
  } catch (...) {
    fail(n, "threw something that is not a std::exception", "");
  }
  record.wall = wall_seconds() - start_ - record.start;
  record.cpu = thread_cpu_seconds() - cpu;
  host->finish(record);
  states_[n].kept = host->kept();
  for (std::size_t i = 0; ok && i < outputs.size(); ++i) {
    ok = outputs[i].data != nullptr;
    if (!ok)
      fail(n, "gave no value for its output '" + node.type->outputs[i].name + "'", "this is a fault of the node type");
  }
  return ok;
}

void Scheduler::fail(std::size_t n, std::string message, std::string help) {
  const std::lock_guard lock(mutex_);  // of a node that is run again others read the status (lost_producer)
  NodeRecord& record = result_.nodes[n];
  record.status = NodeStatus::failed;
  record.message = std::move(message);
  record.help = std::move(help);
}

void Scheduler::note_facts(std::size_t n, const std::vector<Value>& outputs) {
  NodeRecord& record = result_.nodes[n];
  record.facts.assign(outputs.size(), {});
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].facts == nullptr) continue;
    const std::string& port = pipeline_.nodes[n].type->outputs[i].name;
    try {
      record.facts[i] = outputs[i].facts(outputs[i].data.get());
    } catch (const std::exception& error) {
      record.warnings.push_back("output '" + port + "' could not be summed up: " + error.what());
    } catch (...) {
      record.warnings.push_back("output '" + port + "' could not be summed up");
    }
  }
}

void Scheduler::describe(std::size_t n, const std::vector<Value>& outputs) {
  NodeRecord& record = result_.nodes[n];
  record.outputs.clear();
  record.hash_start = wall_seconds() - start_;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const PortInfo& port = pipeline_.nodes[n].type->outputs[i];
    OutputRecord output{port.name, port.type, 0, {}};
    try {
      output.bytes = outputs[i].bytes(outputs[i].data.get());
      if (options_.hashes || cache_ != nullptr) output.hash = outputs[i].hash(outputs[i].data.get());
    } catch (const std::exception& error) {
      record.warnings.push_back("output '" + port.name + "' could not be hashed: " + error.what());
    }
    record.outputs.push_back(std::move(output));
  }
  record.hash_wall = wall_seconds() - start_ - record.hash_start;
}

Scheduler::Inputs Scheduler::inputs_of(std::size_t n) const {
  Inputs inputs;
  inputs.reserve(pipeline_.nodes[n].inputs.size());
  for (const auto& port : pipeline_.nodes[n].inputs) {
    auto& values = inputs.emplace_back();
    for (const Edge& edge : port) values.push_back(states_[edge.node].values[edge.output]);
  }
  return inputs;
}

void Scheduler::keep_outputs(std::size_t n, const std::vector<Value>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (plan_.readers[n][i] > 0) states_[n].values[i] = outputs[i];
}

void Scheduler::release_inputs(std::size_t n, std::vector<Value>& garbage) {
  for (const auto& port : pipeline_.nodes[n].inputs) {
    for (const Edge& edge : port) {
      Value& value = states_[edge.node].values[edge.output];
      if (--plan_.readers[edge.node][edge.output] == 0) garbage.push_back(std::exchange(value, {}));
    }
  }
}

void Scheduler::block(std::size_t follower, std::size_t by) {
  const NodeStatus status = result_.nodes[by].status;
  if (status == NodeStatus::ok) return;
  State& state = states_[follower];
  state.blocked = true;
  if (status == NodeStatus::failed) state.blocker = std::min(state.blocker, by);
  if (status == NodeStatus::skipped) state.blocker = std::min(state.blocker, states_[by].blocker);
}

/// A node that cannot run any more.
void Scheduler::pass_over(std::size_t n, std::vector<Value>& garbage) {
  if (states_[n].blocker != pipeline_.nodes.size()) {
    result_.nodes[n].status = NodeStatus::skipped;
    result_.nodes[n].because = result_.nodes[states_[n].blocker].node;
  }
  states_[n].settled = true;
  release_inputs(n, garbage);
}

// What can run now is put on the queue (returned: how many); what cannot run any more is passed over at once.
std::size_t Scheduler::release_followers(std::size_t n, std::vector<Value>& garbage, std::vector<std::size_t>& passed) {
  std::size_t started = 0;
  std::vector<std::size_t> settled{n};
  while (!settled.empty()) {
    const std::size_t by = settled.back();
    settled.pop_back();
    for (const std::size_t f : plan_.followers[by]) {
      block(f, by);
      if (--plan_.waits[f] > 0) continue;
      if (!states_[f].blocked) {
        push(f, cache_ == nullptr ? Step::run : Step::look);
        ++started;
        continue;
      }
      pass_over(f, garbage);
      passed.push_back(f);
      settled.push_back(f);
    }
  }
  ++stamp_;
  return started;
}

void Scheduler::settle(std::size_t n, const std::vector<Value>& outputs) {
  std::vector<Value> garbage;
  std::vector<std::size_t> passed;
  std::size_t started = 0;
  {
    const std::lock_guard lock(mutex_);
    states_[n].settled = true;
    states_[n].hashes.clear();
    for (const auto& output : result_.nodes[n].outputs) states_[n].hashes.push_back(output.hash);
    keep_outputs(n, outputs);
    release_inputs(n, garbage);
    started = release_followers(n, garbage, passed);
  }
  spawn_(started);
  for (const std::size_t p : passed) progress_.finished(result_.nodes[p]);
  // Here, without the lock and after the next nodes were started, the garbage is freed.
}

}  // namespace atrium
