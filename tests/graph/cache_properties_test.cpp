// What must hold of a cache for every pipeline, tried on random ones.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <set>

#include "graph/cache/cache.hpp"
#include "graph/cache/upkeep.hpp"
#include "graph/run/runner.hpp"
#include "tests/graph/run_nodes.hpp"
#include "tests/support/pipeline_builder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::cache_properties_test {
namespace {

namespace fs = std::filesystem;
using test::Counted;
using test::PipelineBuilder;
using test::Sum;
using test::TemporaryFolder;

/// A pipeline of sums that can be made again with other numbers.
struct Plan {
  std::vector<std::vector<std::size_t>> terms;
  std::vector<std::int64_t> adds;

  PipelineBuilder build() const {
    PipelineBuilder builder;
    for (std::size_t n = 0; n < adds.size(); ++n) {
      std::vector<Source> edges;
      for (const auto t : terms[n]) edges.push_back({t, 0});
      builder.add<Sum>("n" + std::to_string(n), {edges});
      builder.set("add", adds[n]);
    }
    return builder;
  }
  std::vector<std::int64_t> values() const {
    std::vector<std::int64_t> values;
    for (std::size_t n = 0; n < adds.size(); ++n) values.push_back(Sum::value_of(inputs(n, values), adds[n]));
    return values;
  }
  /// What a node depends on.
  using Key = std::pair<std::int64_t, std::vector<std::int64_t>>;
  std::vector<Key> keys() const {
    const auto all = values();
    std::vector<Key> keys;
    for (std::size_t n = 0; n < adds.size(); ++n) keys.push_back({adds[n], inputs(n, all)});
    return keys;
  }

 private:
  std::vector<std::int64_t> inputs(std::size_t n, const std::vector<std::int64_t>& values) const {
    std::vector<std::int64_t> result;
    for (const auto t : terms[n]) result.push_back(values[t]);
    return result;
  }
};

Plan random_plan() {
  Plan plan;
  const auto size = *rc::gen::inRange<std::size_t>(1, 40);
  for (std::size_t n = 0; n < size; ++n) {
    auto& terms = plan.terms.emplace_back();
    for (int i = n == 0 ? 0 : *rc::gen::inRange(0, 4); i > 0; --i)
      terms.push_back(*rc::gen::inRange<std::size_t>(0, n));
    plan.adds.push_back(*rc::gen::inRange<std::int64_t>(-3, 4));  // few: some nodes are the same
  }
  return plan;
}

RunResult run(const Plan& plan, const fs::path& folder, bool keep_all, int threads) {
  PipelineBuilder builder = plan.build();
  Cache cache({folder, 1'000'000'000, keep_all});
  RunOptions options;
  options.threads = threads;
  options.cache = &cache;
  ProgressSink silent;
  return run_pipeline(builder.pipeline(), options, silent);
}

void expect_right(const Plan& plan, const RunResult& result) {
  const auto values = plan.values();
  RC_ASSERT(result.failures.empty());
  RC_ASSERT(!result.cancelled);
  for (std::size_t n = 0; n < values.size(); ++n) {
    RC_ASSERT(result.nodes[n].status == NodeStatus::ok);
    RC_ASSERT(result.nodes[n].outputs.at(0).hash == content_hash(Counted(values[n])));
  }
}

bool was_run(const NodeRecord& node) { return !node.is_hit() || node.cache.again; }

/// Whether exactly those nodes were run whose key was not known: of several with the same key at least one.
void expect_run_once(const Plan& plan, const RunResult& result, const std::set<Plan::Key>& known) {
  const auto keys = plan.keys();
  std::set<Plan::Key> made;
  for (std::size_t n = 0; n < keys.size(); ++n)
    if (was_run(result.nodes[n])) {
      RC_ASSERT(!known.contains(keys[n]));
      made.insert(keys[n]);
    }
  for (const auto& key : keys) RC_ASSERT(known.contains(key) || made.contains(key));
}

RC_GTEST_PROP(CacheProperties, CachedEqualsUncachedAndWhatIsKnownIsNotRun, ()) {
  const Plan plan = random_plan();
  const TemporaryFolder folder(test::memory_folder());
  const int threads = *rc::gen::inRange(1, 4);
  const auto cold = run(plan, folder.path(), true, threads);
  expect_right(plan, cold);
  expect_run_once(plan, cold, {});
  const auto warm = run(plan, folder.path(), true, threads);
  expect_right(plan, warm);
  for (const auto& node : warm.nodes) RC_ASSERT(!was_run(node));
  RC_ASSERT(warm.loaded == 0U);
}

RC_GTEST_PROP(CacheProperties, OneChangedParameterRunsItsDescendantsAndNothingElse, ()) {
  Plan plan = random_plan();
  const TemporaryFolder folder(test::memory_folder());
  const auto before = plan.keys();
  const int threads = *rc::gen::inRange(1, 4);
  run(plan, folder.path(), true, threads);
  const auto changed = *rc::gen::inRange<std::size_t>(0, plan.adds.size());
  plan.adds[changed] += 1000;
  const auto result = run(plan, folder.path(), true, threads);
  expect_right(plan, result);
  expect_run_once(plan, result, {before.begin(), before.end()});
  std::set<std::size_t> descendants{changed};
  for (std::size_t n = changed + 1; n < plan.adds.size(); ++n)
    for (const auto t : plan.terms[n])
      if (descendants.contains(t)) descendants.insert(n);
  for (std::size_t n = 0; n < plan.adds.size(); ++n) RC_ASSERT(!was_run(result.nodes[n]) || descendants.contains(n));
}

/// Values that are not kept, because they are cheap or because someone removed them, are made again where needed.
RC_GTEST_PROP(CacheProperties, ValuesThatAreNotKeptAreMadeAgain, ()) {
  Plan plan = random_plan();
  const TemporaryFolder folder(test::memory_folder());
  const int threads = *rc::gen::inRange(1, 4);
  const bool keep_all = *rc::gen::arbitrary<bool>();
  run(plan, folder.path(), keep_all, threads);
  if (keep_all)
    for (const auto& entry : fs::recursive_directory_iterator(folder / "values"))
      if (entry.is_regular_file() && *rc::gen::arbitrary<bool>()) fs::remove(entry.path());
  plan.adds[*rc::gen::inRange<std::size_t>(0, plan.adds.size())] += 1000;
  const int alive = Counted::alive;
  {
    const auto result = run(plan, folder.path(), keep_all, threads);
    expect_right(plan, result);
  }
  RC_ASSERT(Counted::alive == alive);
}

RC_GTEST_PROP(CacheProperties, DamagedFilesAreNotBelieved, ()) {
  Plan plan = random_plan();
  const TemporaryFolder folder(test::memory_folder());
  const int threads = *rc::gen::inRange(1, 4);
  run(plan, folder.path(), true, threads);
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.is_regular_file() && entry.path().filename() != "CACHEDIR.TAG") files.push_back(entry.path());
  for (int i = *rc::gen::inRange(1, 10); i > 0; --i) {
    const fs::path file = files[*rc::gen::inRange<std::size_t>(0, files.size())];
    std::string bytes = test::read_text(file);
    if (bytes.empty()) continue;
    if (*rc::gen::arbitrary<bool>())
      bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] ^= static_cast<char>(1U << *rc::gen::inRange(0U, 8U));
    else
      bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size()));
    test::write_text(file, bytes);
  }
  plan.adds[*rc::gen::inRange<std::size_t>(0, plan.adds.size())] += *rc::gen::inRange<std::int64_t>(0, 2) * 1000;
  expect_right(plan, run(plan, folder.path(), true, threads));
  std::uint64_t checked = 0;
  verify_cache({folder.path()}, checked);
  RC_ASSERT(verify_cache({folder.path()}, checked).empty());
  expect_right(plan, run(plan, folder.path(), true, threads));
}

RC_GTEST_PROP(CacheProperties, ACancelledRunLeavesACacheThatWorks, ()) {
  Plan plan = random_plan();
  const TemporaryFolder folder(test::memory_folder());
  struct CancelAfter final : ProgressSink {
    explicit CancelAfter(int n) : left(n) {}
    void finished(const NodeRecord& /*node*/) override {
      if (--left <= 0) cancel = true;
    }
    std::atomic<int> left;
    std::atomic<bool> cancel = false;
  };
  for (int i = 0; i < 3; ++i) {
    CancelAfter sink(*rc::gen::inRange(1, 40));
    PipelineBuilder builder = plan.build();
    Cache cache({folder.path(), 1'000'000'000, *rc::gen::arbitrary<bool>()});
    RunOptions options;
    options.threads = *rc::gen::inRange(1, 4);
    options.cancel = &sink.cancel;
    options.cache = &cache;
    const auto result = run_pipeline(builder.pipeline(), options, sink);
    for (const auto& node : result.nodes)
      RC_ASSERT(node.status == NodeStatus::ok || node.status == NodeStatus::cancelled);
    plan.adds[*rc::gen::inRange<std::size_t>(0, plan.adds.size())] += 1000;
  }
  expect_right(plan, run(plan, folder.path(), true, 2));
}

RC_GTEST_PROP(CacheProperties, AFailureWithACacheSkipsItsDescendantsAndNothingElse, ()) {
  const Plan plan = random_plan();
  const TemporaryFolder folder(test::memory_folder());
  std::vector<bool> fails;
  for (std::size_t n = 0; n < plan.adds.size(); ++n) fails.push_back(*rc::gen::inRange(0, 100) < 15);
  for (int i = 0; i < 2; ++i) {
    PipelineBuilder builder = plan.build();
    for (std::size_t n = 0; n < fails.size(); ++n) builder.pipeline()[n].params[1] = static_cast<bool>(fails[n]);
    Cache cache({folder.path(), 1'000'000'000, *rc::gen::arbitrary<bool>()});
    RunOptions options;
    options.threads = *rc::gen::inRange(1, 4);
    options.cache = &cache;
    ProgressSink silent;
    const auto result = run_pipeline(builder.pipeline(), options, silent);
    std::vector<NodeStatus> expected;
    for (std::size_t n = 0; n < fails.size(); ++n) {
      NodeStatus status = fails[n] ? NodeStatus::failed : NodeStatus::ok;
      for (const auto t : plan.terms[n])
        if (expected[t] != NodeStatus::ok) status = NodeStatus::skipped;
      expected.push_back(status);
      RC_ASSERT(result.nodes[n].status == status);
    }
  }
}

}  // namespace
}  // namespace atrium::cache_properties_test
