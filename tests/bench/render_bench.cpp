// Four views of a cloud with their PNG files, as a run makes them.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "modules/render/snapshot.hpp"
#include "tests/bench/box_flat.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using atrium::render::Snapshot;

class Host : public atrium::ContextHost {
 public:
  std::filesystem::path output_folder() override { return folder.path(); }
  atrium::test::TemporaryFolder folder;
};

void four_views(benchmark::State& state) {
  atrium::Context context(1, std::make_shared<Host>());
  const auto cloud = atrium::input(atrium::bench::box_flat(static_cast<std::size_t>(state.range(0))));
  Snapshot::Params params;
  params.views = {"isometric", "top", "front", "inside"};
  for (auto _ : state) benchmark::DoNotOptimize(Snapshot::run({.cloud = cloud}, params, context));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

BENCHMARK(four_views)
    ->Arg(100000)
    ->Arg(1000000)
    ->Arg(4000000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
