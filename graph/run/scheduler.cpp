#include "graph/run/scheduler.hpp"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <tuple>

#include "graph/api/clocks.hpp"
#include "graph/run/run_threads.hpp"

namespace atrium {
namespace {

/// Not after small nodes, of which there may be thousands.
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
      order_(topological_order(pipeline)),
      picture_stamp_(stamp_of(pipeline)),
      states_(node_count(pipeline)) {
  prepare();
}

void Scheduler::prepare() {
  result_.nodes.reserve(states_.size());
  for (const std::size_t n : all_nodes(pipeline_)) {
    result_.nodes.emplace_back(pipeline_[n]);
    states_[n].values.resize(pipeline_[n].type->outputs.size());
    states_[n].readers.resize(pipeline_[n].type->outputs.size());
    states_[n].blocker = states_.size();
  }
  for (const auto& edge : boost::make_iterator_range(boost::edges(pipeline_)))
    ++states_[boost::source(edge, pipeline_)].readers.at(pipeline_[edge].output);
  if (options_.keep_outputs)
    for (const auto& output : pipeline_[whole].outputs) ++states_[output.from.node].readers.at(output.from.output);
  for (auto n = order_.rbegin(); n != order_.rend(); ++n)
    for (const auto& edge : edges_out_of(*n, pipeline_))
      states_[*n].remaining = std::max(states_[*n].remaining, states_[boost::target(edge, pipeline_)].remaining + 1);
}

RunResult Scheduler::run() {
  RunThreads threads(options_.threads > 0 ? options_.threads : tbb::this_task_arena::max_concurrency());
  result_.threads = threads.number();
  if (!threads.shortage().empty()) progress_.message({}, threads.shortage(), true);
  start_ = wall_seconds();
  start_cpu_ = process_cpu_seconds();
  peak_memory_ = peak_memory();
  progress_.planned(states_.size());
  if (cache_ != nullptr) note_builds();
  if (cache_ != nullptr) threads.execute([this] { hash_inputs(); });
  do {
    begin_round();
    threads.execute([&] {
      tbb::task_group group;
      spawn_ = [&](std::size_t tasks) {
        for (std::size_t i = 0; i < tasks; ++i) group.run([this] { guarded_step(); });
      };
      try {
        spawn_(ready_.size());
      } catch (...) {  // no memory for all of them: what has begun must end whole
        end_by(std::current_exception());
      }
      group.wait();
    });
    if (problem_) std::rethrow_exception(problem_);
  } while (lost_ > 0 && !stopping() && !stands_still());
  return result();
}

/// Each round settles more nodes, or finds out of one more that its value or a file of it cannot be had as it was:
/// there is a last one.
void Scheduler::begin_round() {
  lost_ = 0;
  settled_ = 0;
  if (cache_ != nullptr) reopen_readers_of_new_values();
  if (cache_ != nullptr) plan_round();
  std::vector<std::size_t> scheduled;
  for (const std::size_t n : all_nodes(pipeline_)) {
    State& state = states_[n];
    const bool for_values = state.settled && cache_ != nullptr && plan_[n].decision == PlannedNode::Decision::again;
    state.scheduled = !state.settled || for_values;
    state.waits = 0;
    if (!state.scheduled) continue;
    scheduled.push_back(n);
    state.blocked = false;  // what failed may be open again
    state.blocker = states_.size();
    if (for_values)
      for (const auto& edge : edges_into(n, pipeline_))
        ++states_[boost::source(edge, pipeline_)].readers[pipeline_[edge].output];
  }
  for (const std::size_t n : scheduled)
    for (const auto& edge : edges_into(n, pipeline_)) {
      const std::size_t from = boost::source(edge, pipeline_);
      if (states_[from].scheduled)
        ++states_[n].waits;
      else
        block(n, from);  // it may have failed in a round before
    }
  std::vector<std::size_t> ends;  // that have nothing to wait for and cannot run
  for (const std::size_t n : scheduled)
    if (states_[n].waits == 0) states_[n].blocked ? ends.push_back(n) : push(n);
  ++stamp_;
  std::vector<Value> garbage;
  std::vector<std::size_t> passed;
  for (const std::size_t n : ends) {
    if (pass_over(n, garbage)) passed.push_back(n);
    release_followers(n, garbage, passed);
  }
  for (const std::size_t n : passed) tell(n);
}

RunResult Scheduler::result() {
  for (const std::size_t n : all_nodes(pipeline_))  // of a round that was ended
    if (!states_[n].settled) progress_.finished(result_.nodes[n]);
  for (const auto& output : pipeline_[whole].outputs) {
    const Value& value = states_[output.from.node].values[output.from.output];
    if (value.data) result_.outputs[output.name] = value;
  }
  sum_up(result_);
  if (cache_ != nullptr) {
    cache_->finish();
    Cache::Use use = cache_->use();
    result_.cache_folder = cache_->places().folder.string();
    result_.loaded = use.loaded;
    result_.kept = use.kept;
    result_.cache_problems = std::move(use.problems);
  }
  result_.wall = wall_seconds() - start_;
  result_.cpu = process_cpu_seconds() - start_cpu_;
  result_.peak_memory = peak_memory();
  for (const auto& node : result_.nodes) result_.peak_memory = std::max(result_.peak_memory, node.peak_memory);
  return std::move(result_);
}

bool Scheduler::cancelled() const { return ended_ || (options_.cancel != nullptr && options_.cancel->load()); }
bool Scheduler::stopping() const { return cancelled() || (options_.stop != nullptr && options_.stop->load()); }

void Scheduler::push(std::size_t n) {
  ready_.push({stamp_, n, boost::out_degree(n, pipeline_) == 0, states_[n].remaining});
}

/// An exception must not reach the group of tasks: oneTBB would end it by cutting short the loops of all nodes that run
/// meanwhile, without a word to them, and they would hand on half a result as if it were whole.
void Scheduler::guarded_step() {
  try {
    if (!ended_) step();
  } catch (...) {
    end_by(std::current_exception());
  }
}

void Scheduler::end_by(std::exception_ptr problem) {
  const std::lock_guard lock(mutex_);
  if (!problem_) problem_ = std::move(problem);
  ended_ = true;
}

void Scheduler::step() {
  std::size_t next = 0;
  {
    const std::lock_guard lock(mutex_);
    next = ready_.top().node;
    ready_.pop();
  }
  if (!stopping()) {
    if (states_[next].settled)
      run_for_values(next);
    else
      execute(next);
  } else if (!states_[next].settled) {
    tell(next);
    settle(next, {});
  }
}

/// Once more if what was told before holds no longer.
void Scheduler::tell(std::size_t n) {
  if (std::exchange(states_[n].told, true)) progress_.reopened(result_.nodes[n].node);
  progress_.finished(result_.nodes[n]);
}

void Scheduler::execute(std::size_t n) {
  if (cache_ != nullptr && (take_from_cache(n) || !load_inputs(n))) return;
  NodeRecord& record = result_.nodes[n];
  Inputs inputs;
  {
    const std::lock_guard lock(mutex_);
    inputs = values_for(n);
  }
  progress_.started(record.node);
  std::vector<Value> outputs;
  std::optional<std::uint64_t> growth;
  const bool ok = call_watched(n, std::move(inputs), outputs, growth) && note_facts(n, outputs);
  if (ok)
    record.status = NodeStatus::ok;
  else
    outputs.clear();
  if (cache_ == nullptr) {  // what follows need not wait for hashes
    tell(n);
    settle(n, outputs);
    if (ok) describe(n, outputs);
    if (ok) progress_.described(record);
    outputs.clear();
    give_back_memory_of(record);
    return;
  }
  if (ok) {
    describe(n, outputs);
    const std::string drift = compare_with_record(n);
    keep(n, outputs, growth);  // before others start: whatever they do to the process, this is done
    if (!drift.empty()) {
      progress_.message(record.node, drift, true);
      record.warnings.push_back(drift);
    }
  }
  tell(n);
  if (ok) progress_.described(record);
  settle(n, outputs);
  outputs.clear();
  give_back_memory_of(record);
}

void Scheduler::give_back_memory_of(const NodeRecord& record) {
  constexpr double long_node = 0.05;  // seconds
  if (record.wall < long_node) return;
  memory_watch_.disturb();  // a node that has begun meanwhile does not need less by what is given back here
  give_back_memory();
  memory_watch_.disturb();
}

Scheduler::Inputs Scheduler::values_for(std::size_t n) const {
  Inputs inputs;
  for (const auto& port : inputs_of(n, pipeline_)) {
    auto& values = inputs.emplace_back();
    for (const Source& source : port) values.push_back(states_[source.node].values[source.output]);
  }
  return inputs;
}

void Scheduler::keep_outputs(std::size_t n, const std::vector<Value>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (states_[n].readers[i] > 0) states_[n].values[i] = outputs[i];
}

void Scheduler::release_inputs(std::size_t n, std::vector<Value>& garbage) {
  for (const auto& edge : edges_into(n, pipeline_)) {
    State& from = states_[boost::source(edge, pipeline_)];
    const std::size_t output = pipeline_[edge].output;
    if (--from.readers[output] == 0) garbage.push_back(std::exchange(from.values[output], {}));
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

/// A node that cannot run any more. Returns whether that is news.
bool Scheduler::pass_over(std::size_t n, std::vector<Value>& garbage) {
  State& state = states_[n];
  NodeRecord& record = result_.nodes[n];
  release_inputs(n, garbage);
  const bool failed = state.blocker != states_.size();
  if (state.settled) {
    record.status = failed ? NodeStatus::failed : NodeStatus::cancelled;
    if (failed)
      record.message =
          "its value is not kept and cannot be made again: '" + result_.nodes[state.blocker].node + "' failed";
    return failed;
  }
  if (failed) {
    record.status = NodeStatus::skipped;
    record.because = result_.nodes[state.blocker].node;
  }
  state.settled = true;
  return true;
}

// What can run now is put on the queue (returned: how many); what cannot run any more is passed over at once.
std::size_t Scheduler::release_followers(std::size_t n, std::vector<Value>& garbage, std::vector<std::size_t>& passed) {
  std::size_t started = 0;
  std::vector<std::size_t> settled{n};
  while (!settled.empty()) {
    const std::size_t by = settled.back();
    settled.pop_back();
    for (const auto& edge : edges_out_of(by, pipeline_)) {
      const std::size_t follower = boost::target(edge, pipeline_);
      State& state = states_[follower];
      if (!state.scheduled) continue;
      block(follower, by);
      if (--state.waits > 0) continue;
      if (!state.blocked) {
        push(follower);
        ++started;
        continue;
      }
      if (pass_over(follower, garbage)) passed.push_back(follower);
      settled.push_back(follower);
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
    State& state = states_[n];
    ++settled_;
    if (!std::exchange(state.settled, true))
      for (const auto& output : result_.nodes[n].outputs) state.hashes.push_back(output.hash);
    keep_outputs(n, outputs);
    release_inputs(n, garbage);
    started = release_followers(n, garbage, passed);
  }
  spawn_(started);
  for (const std::size_t p : passed) tell(p);
  // Here, without the lock and after the next nodes were started, the garbage is freed.
}

}  // namespace atrium
