#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>

#include "graph/api/clocks.hpp"
#include "graph/api/helper_memory.hpp"
#include "graph/cache/cache.hpp"
#include "graph/cache/records.hpp"
#include "graph/run/runner.hpp"
#include "tests/graph/run_nodes.hpp"
#include "tests/support/pipeline_builder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::run_test {
namespace {

using test::Call;
using test::Counted;
using test::PipelineBuilder;
using test::Sum;

RunResult run(const Pipeline& pipeline, int threads = 2, const std::atomic<bool>* cancel = nullptr) {
  RunOptions options;
  options.threads = threads;
  options.cancel = cancel;
  ProgressSink silent;
  return run_pipeline(pipeline, options, silent);
}

/// Waits until it is so; false if that takes more than twenty seconds.
bool in_time(const std::function<bool()>& so) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!so() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return so();
}

std::shared_ptr<const Counted> value(std::int64_t v = 1) { return input(Counted(v)); }

TEST(Run, AnEmptyPipelineIsDoneAtOnce) {
  const auto result = run(Pipeline{});
  EXPECT_TRUE(result.failures.empty());
  EXPECT_FALSE(result.cancelled);
}

TEST(Run, GivesThePipelinesOutputsAndFreesEverythingElse) {
  const int before = Counted::alive;
  {
    PipelineBuilder b;
    const auto a = b.add<Sum>("a");
    const auto c = b.add<Sum>("c", {{{a, 0}, {a, 0}}});
    const auto d = b.add<Sum>("d", {{{c, 0}}});
    b.output("c", {c, 0});
    b.output("d", {d, 0});
    const auto result = run(b.pipeline());
    ASSERT_EQ(result.outputs.size(), 2U);
    EXPECT_EQ(static_cast<const Counted*>(result.outputs.at("c").data.get())->value, 7);
    EXPECT_EQ(static_cast<const Counted*>(result.outputs.at("d").data.get())->value, 22);
    EXPECT_EQ(Counted::alive - before, 2);
  }
  EXPECT_EQ(Counted::alive, before);
}

TEST(Run, AChainHoldsTwoValuesAtMost) {
  PipelineBuilder b;
  std::size_t last = b.add<Sum>("0");
  for (int i = 1; i < 1000; ++i) last = b.add<Sum>(std::to_string(i), {{{last, 0}}});
  Counted::most = Counted::alive.load();
  const int before = Counted::alive;
  const auto result = run(b.pipeline(), 1);
  EXPECT_TRUE(result.failures.empty());
  EXPECT_LE(Counted::most - before, 3);  // input, output, and the moment of moving it into the graph
}

// Depth first: each branch is finished before the next is begun, so a wide pipeline needs no more memory than a narrow
// one.
TEST(Run, ParallelBranchesDoNotPileUpValues) {
  PipelineBuilder b;
  for (int i = 0; i < 100; ++i) {
    const auto a = b.add<Sum>("load" + std::to_string(i));
    const auto c = b.add<Sum>("work" + std::to_string(i), {{{a, 0}}});
    b.add<Sum>("end" + std::to_string(i), {{{c, 0}}});
  }
  for (const int threads : {1, 2}) {
    Counted::most = Counted::alive.load();
    const int before = Counted::alive;
    run(b.pipeline(), threads);
    EXPECT_LE(Counted::most - before, 5 * threads) << threads;
  }
}

TEST(Run, WhatDependsOnAFailureIsSkippedAndTheRestRuns) {
  PipelineBuilder b;
  const auto a = b.add<Sum>("a");
  const auto bad = b.add<Sum>("bad", {{{a, 0}}});
  b.set("fail", true);
  const auto child = b.add<Sum>("child", {{{bad, 0}, {a, 0}}});
  b.add<Sum>("grandchild", {{{child, 0}}});
  const auto other = b.add<Sum>("other", {{{a, 0}}});
  b.output("child", {child, 0});
  b.output("other", {other, 0});
  const auto result = run(b.pipeline());
  ASSERT_EQ(result.failures.size(), 1U);
  EXPECT_EQ(result.failures[0].node, "bad");
  EXPECT_EQ(result.failures[0].type, "test.sum");
  EXPECT_EQ(result.failures[0].message, "told to fail");
  EXPECT_EQ(result.failures[0].help, "do not tell it");
  EXPECT_EQ(result.nodes[2].status, NodeStatus::skipped);
  EXPECT_EQ(result.nodes[3].status, NodeStatus::skipped);
  EXPECT_EQ(result.nodes[3].because, "bad");
  EXPECT_EQ(result.nodes[4].status, NodeStatus::ok);
  EXPECT_EQ(result.outputs.count("child"), 0U);
  EXPECT_EQ(result.outputs.count("other"), 1U);
}

TEST(Run, AnyExceptionIsANodesFailure) {
  PipelineBuilder b;
  add_call(b, "standard", [](Context&) -> std::shared_ptr<const Counted> { throw std::runtime_error("odd"); });
  add_call(b, "memory", [](Context&) -> std::shared_ptr<const Counted> { throw std::bad_alloc(); });
  add_call(b, "number", [](Context&) -> std::shared_ptr<const Counted> { throw 7; });
  add_call(b, "null", [](Context&) { return std::shared_ptr<const Counted>(); });
  add_call(b, "cancelled", [](Context&) -> std::shared_ptr<const Counted> { throw Cancelled(); });
  add_call(b, "loop", [](Context& context) {
    context.parallel_for(
        100,
        [](std::size_t begin, std::size_t) {
          if (begin == 50) throw Error("in a loop");
        },
        1);
    return value();
  });
  const auto result = run(b.pipeline());
  ASSERT_EQ(result.failures.size(), 6U);
  EXPECT_EQ(result.failures[0].message, "odd");
  EXPECT_EQ(result.failures[1].message, "out of memory");
  EXPECT_NE(result.failures[2].message.find("not a std::exception"), std::string::npos);
  EXPECT_NE(result.failures[3].message.find("'value'"), std::string::npos);
  EXPECT_NE(result.failures[4].message.find("nobody cancelled"), std::string::npos);
  EXPECT_EQ(result.failures[5].message, "in a loop");
  EXPECT_FALSE(result.cancelled);
}

TEST(Run, AnOutputThatCannotBeSummedUpIsAWarning) {
  PipelineBuilder b;
  const auto secret = b.add<test::Hide>("secret");
  b.output("secret", {secret, 0});
  const auto result = run(b.pipeline());
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.outputs.count("secret"), 1U);
  EXPECT_EQ(result.nodes[secret].status, NodeStatus::ok);
  ASSERT_EQ(result.nodes[secret].warnings.size(), 1U);
  EXPECT_EQ(result.nodes[secret].warnings[0], "output 'secret' could not be summed up: it is secret");
}

TEST(Run, CancellingKeepsWhatIsDoneAndStartsNothingMore) {
  std::atomic<bool> cancel = false;
  PipelineBuilder b;
  const auto a = b.add<Sum>("a");
  const auto c = add_call(b, "c",
                          [&](Context& context) {
                            cancel = true;
                            context.parallel_for(
                                1000, [](std::size_t, std::size_t) {}, 1);
                            return value();
                          },
                          {{a, 0}});
  b.add<Sum>("d", {{{c, 0}}});
  b.output("a", {a, 0});
  const auto result = run(b.pipeline(), 1, &cancel);
  EXPECT_TRUE(result.cancelled);
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.nodes[0].status, NodeStatus::ok);
  EXPECT_EQ(result.nodes[1].status, NodeStatus::cancelled);
  EXPECT_EQ(result.nodes[2].status, NodeStatus::cancelled);
  EXPECT_EQ(result.outputs.count("a"), 1U);
}

/// As a sweep whose record of a variant cannot be written.
class FullDisk : public ProgressSink {
 public:
  std::atomic<bool> full = false;
  void finished(const NodeRecord& node) override {
    if (node.node != "a") return;
    full = true;
    throw Error("the disk is full");
  }
};

TEST(Run, WhatEndsARunCutsNoLoopShortInSilence) {
  FullDisk disk;
  std::atomic<bool> begun = false, cut_short = false, told = false;
  PipelineBuilder b;
  add_call(b, "a", [&](Context&) {
    EXPECT_TRUE(in_time([&] { return begun.load(); }));
    return value();
  });
  add_call(b, "b", [&](Context& context) {
    begun = true;
    EXPECT_TRUE(in_time([&] { return disk.full.load(); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // until it is known around here
    std::atomic<std::size_t> done = 0;
    try {
      context.parallel_for(
          1000, [&](std::size_t begin, std::size_t end) { done += end - begin; }, 1);
      cut_short = done < 1000;
    } catch (const Cancelled&) {
      told = true;
      throw;
    }
    return value();
  });
  RunOptions options;
  options.threads = 2;
  EXPECT_THROW(run_pipeline(b.pipeline(), options, disk), Error);
  EXPECT_FALSE(cut_short) << "the node would have given half a result as if it were whole";
  EXPECT_TRUE(told);
}

TEST(Run, OneThreadIsOneThread) {
  PipelineBuilder b;
  std::mutex mutex;
  std::set<std::thread::id> ids;
  std::atomic<int> inside = 0;
  int most = 0;
  for (int i = 0; i < 20; ++i) {
    add_call(b, "n" + std::to_string(i), [&](Context& context) {
      context.parallel_for(
          64,
          [&](std::size_t, std::size_t) {
            const int now = ++inside;
            {
              const std::lock_guard lock(mutex);
              ids.insert(std::this_thread::get_id());
              most = std::max(most, now);
            }
            --inside;
          },
          1);
      return value();
    });
  }
  run(b.pipeline(), 1);
  EXPECT_EQ(ids, std::set{std::this_thread::get_id()});
  EXPECT_EQ(most, 1);
}

// Two nodes that wait for each other can only end if they run at the same time, whatever the machine's number of cores.
TEST(Run, IndependentNodesRunSideBySide) {
  PipelineBuilder b;
  std::atomic<int> there = 0;
  for (int i = 0; i < 4; ++i) {
    add_call(b, "n" + std::to_string(i), [&](Context&) {
      ++there;
      EXPECT_TRUE(in_time([&] { return there == 4; }));
      return value();
    });
  }
  EXPECT_TRUE(run(b.pipeline(), 4).failures.empty());
}

// A thread that waits in a node's loop must not run another node inside it: the first node would be stuck below it.
TEST(Run, ALoopDoesNotStartOtherNodes) {
  PipelineBuilder b;
  thread_local int depth = 0;
  std::atomic<int> deepest = 0;
  for (int i = 0; i < 200; ++i) {
    add_call(b, "n" + std::to_string(i), [&](Context& context) {
      if (++depth > deepest) deepest = depth;
      std::atomic<int> sum = 0;
      context.parallel_for(
          50, [&](std::size_t begin, std::size_t) { sum += static_cast<int>(begin); }, 1);
      --depth;
      return value(sum);
    });
  }
  run(b.pipeline(), 4);
  EXPECT_EQ(deepest, 1);
}

TEST(Run, SeedsDependOnTheRunsSeedAndTheNodesPathOnly) {
  EXPECT_EQ(node_seed(1, "planes"), node_seed(1, "planes"));
  EXPECT_NE(node_seed(1, "planes"), node_seed(2, "planes"));
  EXPECT_NE(node_seed(1, "planes"), node_seed(1, "shell/planes"));
  // Recorded: a change would change every result that draws random numbers.
  EXPECT_EQ(node_seed(1, "planes"), 577927468453281505U);
}

// Half of the node's loop is done by another thread: at least what that thread spent must be in the node's CPU time.
TEST(Run, HelpersCpuTimeCounts) {
  PipelineBuilder b;
  add_call(b, "busy", [](Context& context) {
    const auto own = std::this_thread::get_id();
    std::atomic<int> there = 0;
    const auto work = [&](std::size_t, std::size_t) {
      ++there;
      EXPECT_TRUE(in_time([&] { return there >= 2; }));
      const double start = thread_cpu_seconds();
      while (std::this_thread::get_id() != own && thread_cpu_seconds() - start < 0.05) std::this_thread::yield();
    };
    context.parallel_for(2, work, 1);
    return value();
  });
  EXPECT_GE(run(b.pipeline(), 2).nodes[0].cpu, 0.05);
}

TEST(Run, HelperProgramsMemoryCounts) {
  PipelineBuilder b;
  constexpr std::uint64_t huge = 1ULL << 50U;
  add_call(b, "noting", [](Context&) {
    note_helper_memory(huge);
    note_helper_memory(5);
    return value();
  });
  add_call(b, "plain", [](Context&) { return value(); });
  const auto result = run(b.pipeline(), 1);
  EXPECT_GE(result.nodes[0].peak_memory, huge);
  EXPECT_LT(result.nodes[1].peak_memory, huge);
}

/// What the records say of how much memory each node needed.
std::map<std::string, std::optional<std::uint64_t>> growths(const Pipeline& pipeline) {
  const test::TemporaryFolder folder;
  Cache cache({folder.path()});
  RunOptions options;
  options.threads = 2;
  options.cache = &cache;
  ProgressSink silent;
  run_pipeline(pipeline, options, silent);
  std::map<std::string, std::optional<std::uint64_t>> found;
  for (const auto& record : records_of(cache.places(), "test.call")) found[record.node] = record.growth;
  return found;
}

constexpr std::size_t large = 200'000'000;

TEST(RunMemory, IsNotThatOfTheNodesBeside) {
  PipelineBuilder b;
  std::atomic<bool> allocated = false;
  std::atomic<bool> seen = false;
  add_call(b, "large", [&](Context&) {
    const std::vector<char> memory(large, 'x');
    allocated = true;
    EXPECT_TRUE(in_time([&] { return seen.load(); }));
    return value(memory[large / 2]);
  });
  add_call(b, "small", [&](Context&) {
    EXPECT_TRUE(in_time([&] { return allocated.load(); }));
    seen = true;
    return value(2);
  });
  const auto found = growths(b.pipeline());
  ASSERT_EQ(found.size(), 2U);
  // Neither ran alone, so nothing is known of either: least of all that the small one needed what the large one had.
  EXPECT_EQ(found.at("small"), std::nullopt);
  EXPECT_EQ(found.at("large"), std::nullopt);
}

TEST(RunMemory, IsNotThatOfEarlierNodes) {
  PipelineBuilder b;
  const auto first = add_call(b, "large", [&](Context&) {
    const std::vector<char> memory(large, 'x');
    return value(memory[large / 2]);
  });
  add_call(b, "small", [](Context&) { return value(2); }, {{first, 0}});
  const auto found = growths(b.pipeline());
  ASSERT_TRUE(found.at("large") && found.at("small"));
  EXPECT_GE(*found.at("large"), large * 3 / 4);
  EXPECT_LT(*found.at("small"), large / 2);
}

TEST(Run, ACircleIsAnError) {
  PipelineBuilder b;
  b.add<Sum>("a", {{{1, 0}}});
  b.add<Sum>("b", {{{0, 0}}});
  EXPECT_THROW(run(b.pipeline()), Error);
}

}  // namespace
}  // namespace atrium::run_test
