// Runs with a cache: what is decided before the first node runs, and what happens when that turns out to be wrong.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <mutex>

#include "graph/api/context.hpp"
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

/// Lets the node call a new function: its key is another one, too.
void give(PipelineBuilder& builder, std::size_t n, Call::Function function) {
  Call::functions.push_back(std::move(function));
  builder.pipeline()[n].params[0] = static_cast<std::int64_t>(Call::functions.size() - 1);
}
/// Another function under the same key.
void replace(PipelineBuilder& builder, std::size_t n, Call::Function function) {
  Call::functions[static_cast<std::size_t>(std::get<std::int64_t>(builder.pipeline()[n].params[0]))] =
      std::move(function);
}

/// Counts what is told of each node.
struct CountingSink final : ProgressSink {
  void finished(const NodeRecord& record) override {
    const std::lock_guard lock(mutex);
    ++finishes[record.node];
  }
  void described(const NodeRecord& record) override {
    const std::lock_guard lock(mutex);
    ++descriptions[record.node];
  }
  void reopened(const std::string& node) override {
    const std::lock_guard lock(mutex);
    --finishes[node];
    --descriptions[node];
  }
  std::mutex mutex;
  std::map<std::string, int> finishes, descriptions;
};

class CachedRun : public testing::Test {
 protected:
  RunResult run(PipelineBuilder& builder, bool keep_all = true, int threads = 2) {
    Cache cache({folder.path(), 1'000'000'000, keep_all});
    RunOptions options;
    options.threads = threads;
    options.cache = &cache;
    options.out = out.path();
    CountingSink sink;
    RunResult result = run_pipeline(builder.pipeline(), options, sink);
    for (const auto& node : result.nodes) EXPECT_EQ(sink.finishes[node.node], 1) << node.node;
    for (const auto& node : result.nodes)
      EXPECT_EQ(sink.descriptions[node.node], node.status == NodeStatus::ok ? 1 : 0) << node.node;
    return result;
  }
  void remove_values() const {
    std::error_code ignored;  // a value may be written just now
    std::filesystem::remove_all(folder / "values", ignored);
  }
  static std::string hash_of(std::int64_t number) { return content_hash(Counted(number)); }
  test::TemporaryFolder folder, out;
};

std::shared_ptr<const Counted> value(std::int64_t v) { return input(Counted(v)); }

TEST_F(CachedRun, ANodeWhoseValueIsNotKeptRunsInItsPlaceAndIsToldOfOnce) {
  PipelineBuilder b;
  const auto a = add_call(b, "a", [](Context&) { return value(1); });
  const auto known = b.add<Sum>("known", {{{a, 0}}});
  const auto changed = b.add<Sum>("changed", {{{a, 0}, {known, 0}}});
  run(b);
  remove_values();
  b.set("add", std::int64_t{2});
  const auto result = run(b);
  EXPECT_TRUE(result.failures.empty());
  for (const auto n : {a, known}) {
    EXPECT_TRUE(result.nodes[n].is_hit()) << n;
    EXPECT_TRUE(result.nodes[n].cache.again) << n;
  }
  EXPECT_FALSE(result.nodes[changed].is_hit());
  EXPECT_EQ(result.nodes[changed].outputs.at(0).hash, hash_of(Sum::value_of({1, Sum::value_of({1}, 1)}, 2)));
}

// Another library, another processor: what is computed now is not what the cache says.
TEST_F(CachedRun, AValueThatComesOutOtherwiseReplacesItsRecordAndTheRunGoesOn) {
  PipelineBuilder b;
  const auto a = add_call(b, "a", [](Context&) { return value(1); });
  const auto known = b.add<Sum>("known", {{{a, 0}}});
  const auto after = b.add<Sum>("after", {{{known, 0}}});
  const auto changed = b.add<Sum>("changed", {{{a, 0}}});
  run(b);
  remove_values();
  b.set("add", std::int64_t{2});
  replace(b, a, [](Context&) { return value(10); });
  const auto expect_new = [&](const RunResult& result) {
    EXPECT_TRUE(result.failures.empty());
    EXPECT_EQ(result.nodes[a].outputs.at(0).hash, hash_of(10));
    EXPECT_EQ(result.nodes[known].outputs.at(0).hash, hash_of(Sum::value_of({10}, 1)));
    EXPECT_EQ(result.nodes[after].outputs.at(0).hash, hash_of(Sum::value_of({Sum::value_of({10}, 1)}, 1)));
    EXPECT_EQ(result.nodes[changed].outputs.at(0).hash, hash_of(Sum::value_of({10}, 2)));
  };
  const auto result = run(b);
  expect_new(result);
  EXPECT_EQ(result.nodes[a].cache.why, "run again, it gave another 'value' than before");
  ASSERT_EQ(result.nodes[a].warnings.size(), 1U);
  EXPECT_NE(result.nodes[a].warnings[0].find("what depends on it is computed anew"), std::string::npos);
  const auto next = run(b);
  expect_new(next);
  for (const auto& node : next.nodes) {
    EXPECT_TRUE(node.is_hit() && !node.cache.again) << node.node;
    EXPECT_TRUE(node.warnings.empty()) << node.node;
  }
}

/// `sum` reads a value that is kept, and one of a node that does something before it gives its own.
struct Interrupted {
  PipelineBuilder b;
  std::size_t kept, between, known, sum, end;
  explicit Interrupted(Call::Function interruption) {
    kept = add_call(b, "kept", [](Context&) { return value(5); });
    known = b.add<Sum>("known", {{{kept, 0}}});
    between = add_call(b, "between", [](Context&) { return value(7); });
    sum = b.add<Sum>("sum", {{{kept, 0}, {between, 0}}});
    end = b.add<Sum>("end", {{{sum, 0}}});
    second = std::move(interruption);
  }
  void change() { give(b, between, second); }
  Call::Function second;
};

TEST_F(CachedRun, AValueThatGoesMeanwhileIsMadeAgain) {
  Interrupted p([this](Context&) {
    remove_values();
    return value(8);
  });
  run(p.b);
  p.change();
  for (const int threads : {1, 3}) {
    const auto result = run(p.b, true, threads);
    EXPECT_TRUE(result.failures.empty());
    EXPECT_EQ(result.nodes[p.sum].outputs.at(0).hash, hash_of(Sum::value_of({5, 8}, 1)));
    EXPECT_EQ(result.nodes[p.end].status, NodeStatus::ok);
    EXPECT_TRUE(result.nodes[p.known].is_hit());
    EXPECT_EQ(result.nodes[p.kept].status, NodeStatus::ok);
    EXPECT_TRUE(result.nodes[p.kept].cache.again);
    give(p.b, p.between, p.second);  // once more, with another key
  }
}

// `known` and what follows have used the 5 already.
TEST_F(CachedRun, AValueThatGoesMeanwhileAndComesOutOtherwiseOpensAgainWhatUsedIt) {
  std::int64_t other = 0;
  Interrupted p([this, &other](Context&) {
    remove_values();
    return value(other);
  });
  const auto after = p.b.add<Sum>("after", {{{p.known, 0}}});
  run(p.b);
  for (const int threads : {1, 3}) {
    p.change();
    const std::int64_t now = 5 + threads;
    other = 10 * threads;
    replace(p.b, p.kept, [now](Context&) { return value(now); });
    const auto expect_new = [&](const RunResult& result) {
      EXPECT_TRUE(result.failures.empty());
      const std::int64_t known = Sum::value_of({now}, 1);
      EXPECT_EQ(result.nodes[p.kept].outputs.at(0).hash, hash_of(now));
      EXPECT_EQ(result.nodes[p.known].outputs.at(0).hash, hash_of(known));
      EXPECT_EQ(result.nodes[after].outputs.at(0).hash, hash_of(Sum::value_of({known}, 1)));
      const std::int64_t sum = Sum::value_of({now, other}, 1);
      EXPECT_EQ(result.nodes[p.sum].outputs.at(0).hash, hash_of(sum));
      EXPECT_EQ(result.nodes[p.end].outputs.at(0).hash, hash_of(Sum::value_of({sum}, 1)));
    };
    const auto result = run(p.b, true, threads);
    expect_new(result);
    ASSERT_EQ(result.nodes[p.kept].warnings.size(), 1U);
    EXPECT_NE(result.nodes[p.kept].warnings[0].find("what depends on it is done anew"), std::string::npos);
    const auto next = run(p.b, true, threads);
    expect_new(next);
    for (const auto& node : next.nodes) EXPECT_TRUE(node.is_hit() && node.warnings.empty()) << node.node;
  }
}

// A node that gives something else each time: it is not to be cached, and the run ends.
TEST_F(CachedRun, AValueThatIsNeverTheSameFailsInTheEnd) {
  Interrupted p([this](Context&) {
    remove_values();
    return value(8);
  });
  run(p.b, false);
  p.change();
  std::int64_t times = 100;
  replace(p.b, p.kept, [&times, this](Context&) {
    remove_values();
    return value(++times);
  });
  const auto result = run(p.b, false, 1);
  EXPECT_LT(times, 110);
  for (const auto& failure : result.failures) EXPECT_FALSE(failure.help.empty()) << failure.message;
}

/// Writes `name`, and reads what `after` gives.
std::size_t add_writer(PipelineBuilder& b, const std::string& name, std::size_t after) {
  return add_call(b, name,
                  [name](Context& context) {
                    const auto file = context.output(name);
                    AtomicFile out(file);
                    out.write(name);
                    out.commit();
                    context.wrote(file);
                    return value(1);
                  },
                  {{after, 0}});
}

// The values of cheap nodes are not kept, and here what the last one wrote is not either.
TEST_F(CachedRun, AFileThatIsNotKeptAnyMoreIsWrittenAgain) {
  PipelineBuilder b;
  const auto first = add_call(b, "first", [](Context&) { return value(1); });
  const auto middle = b.add<Sum>("middle", {{{first, 0}}});
  const auto last = add_writer(b, "last.txt", middle);
  run(b, false);
  std::filesystem::remove_all(folder / "files");
  const auto result = run(b, false);
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.nodes[last].status, NodeStatus::ok);
  EXPECT_EQ(result.nodes[last].cache.why, "a file that it wrote is not kept any more");
  EXPECT_TRUE(result.nodes[middle].cache.again);
  const auto next = run(b, false);
  for (const auto& node : next.nodes) EXPECT_TRUE(node.is_hit() && !node.cache.again) << node.node;
}

// One branch fails, the value of another is lost: a second round, in which their reader cannot run.
TEST_F(CachedRun, AFailedBranchAndALostValueMeet) {
  Interrupted p([this](Context&) {
    remove_values();
    return value(8);
  });
  const auto broken = add_call(p.b, "broken", [](Context&) { return value(1); });
  const auto joined = p.b.add<Sum>("joined", {{{broken, 0}, {p.sum, 0}}});
  const auto last = p.b.add<Sum>("last", {{{joined, 0}}});
  run(p.b);
  for (const int threads : {1, 3}) {
    p.change();
    give(p.b, broken, [](Context&) -> std::shared_ptr<const Counted> { throw Error("broken"); });
    const auto result = run(p.b, true, threads);
    ASSERT_EQ(result.failures.size(), 1U);
    EXPECT_EQ(result.failures[0].message, "broken");
    EXPECT_EQ(result.nodes[p.end].status, NodeStatus::ok);
    for (const auto n : {joined, last}) {
      EXPECT_EQ(result.nodes[n].status, NodeStatus::skipped) << n;
      EXPECT_EQ(result.nodes[n].because, "broken") << n;
    }
  }
}

TEST_F(CachedRun, ANodeThatFailsWhenItRunsAgainSkipsWhatReadsIt) {
  PipelineBuilder b;
  const auto a = add_call(b, "a", [](Context&) { return value(1); });
  const auto known = b.add<Sum>("known", {{{a, 0}}});
  const auto changed = b.add<Sum>("changed", {{{a, 0}}});
  run(b);
  remove_values();
  b.set("add", std::int64_t{2});
  replace(b, a, [](Context&) -> std::shared_ptr<const Counted> { throw Error("gone"); });
  const auto result = run(b);
  EXPECT_EQ(result.nodes[a].status, NodeStatus::failed);
  EXPECT_EQ(result.nodes[a].message, "gone");
  for (const auto n : {known, changed}) EXPECT_EQ(result.nodes[n].status, NodeStatus::skipped);
}

}  // namespace
}  // namespace atrium::cached_run_test
