// Runs with a cache in which a node is run again, for a value that was not kept, while others look at its record. What
// they must not see is asserted here; that nothing is read while it is written, tests/sanitize says (ThreadSanitizer).
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "graph/cache/cache.hpp"
#include "graph/run/runner.hpp"
#include "tests/graph/run_nodes.hpp"
#include "tests/support/pipeline_builder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::cached_run_test {
namespace {

using test::Call;
using test::Counted;
using test::PipelineBuilder;
using test::Sum;
using namespace std::chrono_literals;

/// Waits for the flag; false if it is not set within ten seconds.
bool wait_for(const std::atomic<bool>& flag) {
  for (const auto end = std::chrono::steady_clock::now() + 10s; !flag; std::this_thread::sleep_for(1ms))
    if (std::chrono::steady_clock::now() > end) return false;
  return true;
}

/// Lets the node call a new function: its key is another one, too.
void give(PipelineBuilder& builder, std::size_t n, Call::Function function) {
  Call::functions.push_back(std::move(function));
  builder.pipeline().nodes[n].params[0] = static_cast<std::int64_t>(Call::functions.size() - 1);
}
/// Another function under the same key.
void replace(PipelineBuilder& builder, std::size_t n, Call::Function function) {
  Call::functions[static_cast<std::size_t>(std::get<std::int64_t>(builder.pipeline().nodes[n].params[0]))] =
      std::move(function);
}

RunResult run(PipelineBuilder& builder, const std::filesystem::path& folder, ProgressSink& sink, int threads = 2) {
  Cache cache({folder});
  RunOptions options;
  options.threads = threads;
  options.cache = &cache;
  return run_pipeline(builder.pipeline(), options, sink);
}

/// Runs the pipeline and leaves the records of its nodes in the cache, but no value.
void run_once(PipelineBuilder& builder, const std::filesystem::path& folder) {
  ProgressSink silent;
  run(builder, folder, silent);
  std::filesystem::remove_all(folder / "values");
}

std::shared_ptr<const Counted> value(std::int64_t v) { return input(Counted(v)); }

/// Takes its time with the record of node a.
struct SlowSink final : ProgressSink {
  explicit SlowSink(const std::atomic<bool>& flag) : ran_again(flag) {}
  void described(const NodeRecord& record) override {
    if (record.node != "a") return;
    const NodeRecord before = record;
    in_time = wait_for(ran_again);
    same = record.wall == before.wall && record.start == before.start && record.cache.again == before.cache.again &&
           record.outputs.size() == before.outputs.size() && record.facts.size() == before.facts.size();
  }
  const std::atomic<bool>& ran_again;
  std::atomic<bool> in_time = false, same = false;
};

TEST(CachedRun, ARecordStaysAsItWasToldWhileItsNodeRunsAgain) {
  const test::TemporaryFolder folder;
  PipelineBuilder b;
  std::atomic<bool> ran_again = false;
  const auto a = add_call(b, "a", [](Context&) { return value(1); });
  b.add<Sum>("b", {{{a, 0}}});
  run_once(b, folder.path());
  b.set("add", std::int64_t{2});  // b is another node now, and needs the value of a
  replace(b, a, [](Context&) {
    std::this_thread::sleep_for(20ms);  // not as fast as the first time
    return value(1);
  });
  const auto c = add_call(b, "c",
                          [&](Context&) {
                            ran_again = true;
                            return value(3);
                          },
                          {{1, 0}});
  SlowSink sink(ran_again);
  const auto result = run(b, folder.path(), sink);
  EXPECT_EQ(result.nodes[c].status, NodeStatus::ok);
  EXPECT_TRUE(result.nodes[a].cache.again);
  EXPECT_TRUE(sink.in_time);
  EXPECT_TRUE(sink.same);
}

// c asks whether a has failed while a, which was known, runs again and fails.
TEST(CachedRun, ANodeThatFailsWhenItRunsAgainIsSeenToHaveFailed) {
  const test::TemporaryFolder folder;
  PipelineBuilder b;
  const auto a = add_call(b, "a", [](Context&) { return value(1); });
  const auto first = b.add<Sum>("first", {{{a, 0}}});
  const auto d = add_call(b, "d", [](Context&) { return value(4); });
  const auto second = b.add<Sum>("second", {{{a, 0}, {d, 0}}});
  run_once(b, folder.path());
  std::atomic<bool> begun = false;
  std::atomic<bool> asked = false;
  replace(b, a, [&](Context&) -> std::shared_ptr<const Counted> {
    begun = true;
    wait_for(asked);
    std::this_thread::sleep_for(50ms);  // so long the second sum has had to look for the first one's value
    throw Error("gone");
  });
  b.pipeline().nodes[first].params[0] = std::int64_t{5};
  b.pipeline().nodes[second].params[0] = std::int64_t{6};
  give(b, d, [&](Context&) {
    wait_for(begun);
    asked = true;
    return value(4);
  });
  ProgressSink silent;
  const auto result = run(b, folder.path(), silent, 3);
  EXPECT_EQ(result.nodes[a].status, NodeStatus::failed);
  EXPECT_EQ(result.nodes[a].message, "gone");
  for (const auto n : {first, second}) EXPECT_EQ(result.nodes[n].status, NodeStatus::skipped);
}

}  // namespace
}  // namespace atrium::cached_run_test
