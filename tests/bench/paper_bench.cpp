// The whole of pipelines/paper.yaml without Poisson, file to file, as its user starts it: a new process that reads the
// scan of a simulated flat and writes its results. Budgets on 2 cores: 2 s for 1 M points, 7 s for 4 M; memory below
// 200 bytes a point over the file's own size.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace atrium::test;

void run(std::vector<std::string> words) {
  words.insert(words.begin(), {ATRIUM_PROGRAM, "run", "--quiet"});
  ProcessOptions options;
  options.folder = ATRIUM_SOURCE_DIR;
  const auto result = run_process(words, options);
  if (result.exit_code != 0) throw std::runtime_error(result.err);
}

void paper(benchmark::State& state) {
  const TemporaryFolder folder;
  const std::string scan = (folder / "scan/scan.ply").string();
  run({"pipelines/simulate.yaml", "-s", "points=" + std::to_string(state.range(0)), "--out",
       (folder / "scan").string()});
  for (auto _ : state)
    run({"pipelines/paper.yaml", "-s", "scan=" + scan, "-s", "objects.type=object.none", "--out",
         (folder / "model").string()});
  const auto manifest = nlohmann::json::parse(read_text(folder / "model/manifest.json"));
  const double points = static_cast<double>(state.range(0));
  const double over = manifest["peak_memory"].get<double>() - static_cast<double>(std::filesystem::file_size(scan));
  state.counters["bytes_per_point"] = over / points;
  state.counters["points/s"] = benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(paper)->Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(3.0);

}  // namespace
