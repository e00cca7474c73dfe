// The whole of pipelines/atrium.yaml, file to file, as its user starts it: a new process that reads the scan of a
// simulated office and writes building, floor plan, model and images. Budgets on 2 cores: 4 s and 1 GB for 4 M points.
#include <benchmark/benchmark.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace atrium::test;

ProcessResult run(std::vector<std::string> words) {
  words.insert(words.begin(), {ATRIUM_PROGRAM, "run", "--quiet", "--no-cache"});
  ProcessOptions options;
  options.folder = ATRIUM_SOURCE_DIR;
  auto result = run_process(words, options);
  if (result.exit_code != 0) throw std::runtime_error(result.err);
  return result;
}

nlohmann::json manifest(const TemporaryFolder& folder) {
  return nlohmann::json::parse(read_text(folder / "model/manifest.json"));
}

void simulate(const TemporaryFolder& folder, std::int64_t points) {
  run({"pipelines/simulate.yaml", "-s", "scene.type=synth.office", "-s", "points=" + std::to_string(points), "--out",
       (folder / "scan").string()});
}

void model(const TemporaryFolder& folder) {
  run({"pipelines/atrium.yaml", "-s", "scan=" + (folder / "scan/scan.ply").string(), "--out",
       (folder / "model").string()});
}

void office(benchmark::State& state) {
  const TemporaryFolder folder;
  simulate(folder, state.range(0));
  for (auto _ : state) model(folder);
  const auto record = manifest(folder);
  state.counters["cpu_s"] = record["cpu_seconds"].get<double>();
  state.counters["peak_MB"] = record["peak_memory"].get<double>() / 1e6;
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(state.range(0)), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(office)->Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(3.0);

/// The nodes of the layout alone, in the same run: their times from its manifest.
void layout(benchmark::State& state) {
  const TemporaryFolder folder;
  simulate(folder, state.range(0));
  for (auto _ : state) {
    model(folder);
    double seconds = 0;
    const auto record = manifest(folder);
    for (const auto& node : record["nodes"])
      if (node["type"].get<std::string>().starts_with("layout.")) seconds += node["wall_seconds"].get<double>();
    state.SetIterationTime(seconds);
  }
}
BENCHMARK(layout)
    ->Arg(100000)
    ->Arg(1000000)
    ->Arg(4000000)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(3);

}  // namespace
