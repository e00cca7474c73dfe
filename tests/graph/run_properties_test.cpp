// Properties that must hold for every pipeline, tried on random ones.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "graph/run/runner.hpp"
#include "tests/graph/run_nodes.hpp"
#include "tests/support/pipeline_builder.hpp"

namespace atrium::run_properties_test {
namespace {

using test::Counted;
using test::PipelineBuilder;
using test::Sum;

struct RandomPipeline {
  PipelineBuilder builder;
  std::vector<std::vector<std::size_t>> terms;  // per node
  std::vector<std::int64_t> adds;
  std::vector<bool> fails;
};

// Up to 40 nodes, each reading up to three earlier ones (also the same one twice); a node in `failing` per hundred
// throws.
RandomPipeline random_pipeline(int failing) {
  RandomPipeline p;
  const auto size = *rc::gen::inRange<std::size_t>(1, 40);
  for (std::size_t n = 0; n < size; ++n) {
    const auto count_of_terms = n == 0 ? 0 : *rc::gen::inRange(0, 4);
    std::vector<Source> edges;
    p.terms.emplace_back();
    for (int i = 0; i < count_of_terms; ++i) {
      p.terms.back().push_back(*rc::gen::inRange<std::size_t>(0, n));
      edges.push_back({p.terms.back().back(), 0});
    }
    p.adds.push_back(*rc::gen::arbitrary<std::int64_t>());
    p.fails.push_back(*rc::gen::inRange(0, 100) < failing);
    p.builder.add<Sum>("n" + std::to_string(n), {edges});
    p.builder.set("add", p.adds.back()).set("fail", static_cast<bool>(p.fails.back()));
    if (*rc::gen::inRange(0, 4) == 0) p.builder.output("out" + std::to_string(n), {n, 0});
  }
  return p;
}

RunResult run(const Pipeline& pipeline, int threads, const std::atomic<bool>* cancel = nullptr) {
  RunOptions options;
  options.threads = threads;
  options.cancel = cancel;
  ProgressSink silent;
  return run_pipeline(pipeline, options, silent);
}

std::int64_t number(const Value& value) { return static_cast<const Counted*>(value.data.get())->value; }

RC_GTEST_PROP(RunProperties, AnyNumberOfThreadsEqualsADirectEvaluation, ()) {
  auto p = random_pipeline(0);
  std::vector<std::int64_t> expected;
  for (std::size_t n = 0; n < p.adds.size(); ++n) {
    std::vector<std::int64_t> values;
    for (const auto t : p.terms[n]) values.push_back(expected[t]);
    expected.push_back(Sum::value_of(values, p.adds[n]));
  }
  for (const int threads : {1, 2, 5}) {
    const auto result = run(p.builder.pipeline(), threads);
    RC_ASSERT(result.failures.empty());
    RC_ASSERT(result.outputs.size() == p.builder.pipeline()[whole].outputs.size());
    for (const auto& output : p.builder.pipeline()[whole].outputs)
      RC_ASSERT(number(result.outputs.at(output.name)) == expected[output.from.node]);
    for (std::size_t n = 0; n < expected.size(); ++n)
      RC_ASSERT(result.nodes[n].outputs.at(0).hash == content_hash(Counted(expected[n])));
  }
}

RC_GTEST_PROP(RunProperties, OnlyThePipelinesOutputsOutliveTheRun, ()) {
  auto p = random_pipeline(10);
  const int before = Counted::alive;
  {
    const auto result = run(p.builder.pipeline(), 3);
    std::set<const void*> kept;
    for (const auto& [name, value] : result.outputs) kept.insert(value.data.get());
    RC_ASSERT(static_cast<std::size_t>(Counted::alive - before) == kept.size());
  }
  RC_ASSERT(Counted::alive == before);
}

RC_GTEST_PROP(RunProperties, NothingOutlivesARunThatKeepsNoOutputs, ()) {
  auto p = random_pipeline(10);
  const int before = Counted::alive;
  RunOptions options;
  options.threads = 3;
  options.keep_outputs = false;
  ProgressSink silent;
  const auto result = run_pipeline(p.builder.pipeline(), options, silent);
  RC_ASSERT(result.outputs.empty());
  RC_ASSERT(Counted::alive == before);
}

// The most values alive at once in a serial run are those that are needed: made, and read later or being read.
RC_GTEST_PROP(RunProperties, SerialRunsHoldLiveEdgesOnly, ()) {
  auto p = random_pipeline(0);
  const int before = Counted::alive;
  Counted::most = before;
  const auto result = run(p.builder.pipeline(), 1);
  // Replays the order of the run (ties of the clock are in no one's way: nodes are ordered by their start).
  std::vector<std::size_t> order(p.adds.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto earlier = [&](std::size_t a, std::size_t b) { return result.nodes[a].start < result.nodes[b].start; };
  std::sort(order.begin(), order.end(), earlier);
  std::vector<std::size_t> needs(order.size());
  for (std::size_t n = 0; n < order.size(); ++n)
    for (const auto t : p.terms[n]) ++needs[t];
  for (const auto& output : p.builder.pipeline()[whole].outputs) ++needs[output.from.node];
  int live = 0;
  int most = 0;
  for (const auto n : order) {
    most = std::max(most, live + 2);  // the node's own result, once where it is made and once where it is moved to
    live += needs[n] > 0 ? 1 : 0;
    for (const auto t : p.terms[n]) live -= --needs[t] == 0 ? 1 : 0;
  }
  RC_ASSERT(Counted::most - before <= most);
}

RC_GTEST_PROP(RunProperties, AFailureSkipsItsDescendantsAndNothingElse, ()) {
  auto p = random_pipeline(15);
  std::vector<NodeStatus> expected;
  for (std::size_t n = 0; n < p.adds.size(); ++n) {
    NodeStatus status = p.fails[n] ? NodeStatus::failed : NodeStatus::ok;
    for (const auto t : p.terms[n])
      if (expected[t] != NodeStatus::ok) status = NodeStatus::skipped;
    expected.push_back(status);
  }
  for (const int threads : {1, 4}) {
    const auto result = run(p.builder.pipeline(), threads);
    RC_ASSERT(!result.cancelled);
    for (std::size_t n = 0; n < expected.size(); ++n) RC_ASSERT(result.nodes[n].status == expected[n]);
  }
}

RC_GTEST_PROP(RunProperties, CancelledAtAnyPointEveryNodeIsEitherDoneOrNot, ()) {
  auto p = random_pipeline(0);
  struct CancelAfter final : ProgressSink {
    explicit CancelAfter(int n) : left(n) {}
    void finished(const NodeRecord& /*node*/) override {
      if (--left <= 0) cancel = true;
    }
    std::atomic<int> left;
    std::atomic<bool> cancel = false;
  } sink(*rc::gen::inRange(1, 40));
  RunOptions options;
  options.threads = *rc::gen::inRange(1, 4);
  options.cancel = &sink.cancel;
  const auto result = run_pipeline(p.builder.pipeline(), options, sink);
  bool all = true;
  for (std::size_t n = 0; n < p.adds.size(); ++n) {
    const NodeStatus status = result.nodes[n].status;
    RC_ASSERT(status == NodeStatus::ok || status == NodeStatus::cancelled);
    all = all && status == NodeStatus::ok;
    for (const auto t : p.terms[n]) RC_ASSERT(status != NodeStatus::ok || result.nodes[t].status == NodeStatus::ok);
  }
  RC_ASSERT(result.cancelled == !all);
}

}  // namespace
}  // namespace atrium::run_properties_test
