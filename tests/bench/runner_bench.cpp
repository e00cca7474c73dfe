// What the framework itself costs per node: nodes that add two numbers, in a chain, a fan and a grid of layers.
// "recorded" includes the run's folder (resolved.yaml, manifest.json, trace.json, each written safely to the disk).
#include <benchmark/benchmark.h>

#include "graph/run/runner.hpp"
#include "tests/support/pipeline_builder.hpp"

namespace {

using atrium::Source;

struct Add {
  static constexpr std::string_view type = "bench.add";
  static constexpr std::string_view summary = "Adds.";
  struct In {
    atrium::Inputs<std::int64_t> terms;
  };
  struct Out {
    std::int64_t sum = 0;
  };
  struct Params {
    std::int64_t add = 1;
    double scale = 1;
  };
  static constexpr auto inputs = std::tuple{atrium::port<&In::terms>("")};
  static constexpr auto outputs = std::tuple{atrium::port<&Out::sum>("")};
  static constexpr auto params = std::tuple{atrium::param<&Params::add>(atrium::count, atrium::unbounded, ""),
                                            atrium::param<&Params::scale>(atrium::ratio, atrium::unbounded, "")};
  static Out run(const In& in, const Params& params, atrium::Context& /*context*/) {
    Out out{params.add};
    for (const auto& t : in.terms) out.sum += *t;
    return out;
  }
};

using Builder = atrium::test::PipelineBuilder;

void chain(Builder& builder, std::size_t nodes) {
  std::size_t last = builder.add<Add>("n0");
  while (atrium::node_count(builder.pipeline()) < nodes)
    last = builder.add<Add>("n" + std::to_string(last + 1), {{{last, 0}}});
}
void fan(Builder& builder, std::size_t nodes) {
  const std::size_t root = builder.add<Add>("root");
  std::vector<Source> ends;
  while (atrium::node_count(builder.pipeline()) + 1 < nodes)
    ends.push_back({builder.add<Add>("n" + std::to_string(ends.size()), {{{root, 0}}}), 0});
  builder.add<Add>("join", {ends});
}
void layers(Builder& builder, std::size_t nodes) {
  constexpr std::size_t width = 10;
  for (std::size_t i = 0; i < nodes; ++i) {
    std::vector<Source> below;
    if (i >= width) below = {{i - width, 0}, {i / width * width - 1 - i % width, 0}};
    builder.add<Add>("n" + std::to_string(i), {below});
  }
}

void run(benchmark::State& state, void (*build)(Builder&, std::size_t), bool recorded) {
  Builder builder;
  const auto nodes = static_cast<std::size_t>(state.range(0));
  build(builder, nodes);
  atrium::RunOptions options;
  options.threads = static_cast<int>(state.range(1));
  if (recorded) options.out = std::filesystem::temp_directory_path() / "atrium-runner-bench";
  atrium::ProgressSink silent;
  for (auto _ : state) {
    const auto result = atrium::run_pipeline(builder.pipeline(), options, silent);
    if (!result.failures.empty()) state.SkipWithError("a node failed");
  }
  state.counters["per_node"] = benchmark::Counter(
      static_cast<double>(nodes), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  if (recorded) std::filesystem::remove_all(options.out);
}

}  // namespace

BENCHMARK_CAPTURE(run, chain, chain, false)->ArgsProduct({{100, 1000, 10000}, {1, 2}})->UseRealTime();
BENCHMARK_CAPTURE(run, fan, fan, false)->ArgsProduct({{100, 1000, 10000}, {1, 2}})->UseRealTime();
BENCHMARK_CAPTURE(run, layers, layers, false)->ArgsProduct({{100, 1000, 10000}, {1, 2}})->UseRealTime();
BENCHMARK_CAPTURE(run, recorded, layers, true)->ArgsProduct({{100, 1000, 10000}, {2}})->UseRealTime();
