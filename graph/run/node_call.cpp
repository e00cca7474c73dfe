// The scheduler's steps with one node: it is called, and what it gives is described.
#include <tbb/task_arena.h>

#include <new>

#include "graph/api/clocks.hpp"
#include "graph/api/helper_memory.hpp"
#include "graph/run/node_host.hpp"
#include "graph/run/scheduler.hpp"

namespace atrium {
namespace {

// Nodes shorter than this share the last reading of the process's peak memory: a reading takes about as long as a small
// node.
constexpr double peak_reading_interval = 1e-3;
constexpr const char* help_for_memory = "give it fewer points (a coarser voxel grid, a crop), or run with -j 1";

}  // namespace

/// call(), with what happens to the process's memory.
bool Scheduler::call_watched(std::size_t n, Inputs inputs, std::vector<Value>& outputs,
                             std::optional<std::uint64_t>& growth) {
  NodeRecord& record = result_.nodes[n];
  const bool watched = cache_ != nullptr;
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

bool Scheduler::call(std::size_t n, const Inputs& inputs, std::vector<Value>& outputs) {
  const PipelineNode& node = pipeline_[n];
  NodeRecord& record = result_.nodes[n];
  const PngStamp& stamp = options_.stamp ? options_.stamp(node) : picture_stamp_;
  Cache* keeper = states_[n].found.key.fields.empty() ? nullptr : cache_;
  const auto host = std::make_shared<NodeHost>(
      record.node, options_.out, node.folder, [this] { return cancelled(); }, stamp, progress_, keeper);
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
    fail(n, "out of memory", help_for_memory);
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
  NodeRecord& record = result_.nodes[n];
  record.status = NodeStatus::failed;
  record.message = std::move(message);
  record.help = std::move(help);
}

/// What is printed of the outputs. False: there was no memory for it, the node has failed.
bool Scheduler::note_facts(std::size_t n, const std::vector<Value>& outputs) {
  NodeRecord& record = result_.nodes[n];
  record.outputs.clear();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const PortInfo& port = pipeline_[n].type->outputs[i];
    OutputRecord& output = record.outputs.emplace_back(OutputRecord{port.name, port.type});
    if (outputs[i].facts == nullptr) continue;
    try {
      output.facts = outputs[i].facts(outputs[i].data.get());
    } catch (const std::bad_alloc&) {
      fail(n, "out of memory", help_for_memory);
      record.outputs.clear();
      return false;
    } catch (const std::exception& error) {
      record.warnings.push_back("output '" + port.name + "' could not be summed up: " + error.what());
    } catch (...) {
      record.warnings.push_back("output '" + port.name + "' could not be summed up");
    }
  }
  return true;
}

/// Sizes and hashes, after note_facts().
void Scheduler::describe(std::size_t n, const std::vector<Value>& outputs) {
  NodeRecord& record = result_.nodes[n];
  record.hash_start = wall_seconds() - start_;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    OutputRecord& output = record.outputs[i];
    try {
      output.bytes = outputs[i].bytes(outputs[i].data.get());
      if (options_.hashes || cache_ != nullptr) output.hash = outputs[i].hash(outputs[i].data.get());
    } catch (const std::exception& error) {
      record.warnings.push_back("output '" + output.port + "' could not be hashed: " + error.what());
    } catch (...) {
      record.warnings.push_back("output '" + output.port + "' could not be hashed");
    }
  }
  record.hash_wall = wall_seconds() - start_ - record.hash_start;
}

}  // namespace atrium
