#include <benchmark/benchmark.h>

#include "modules/filter/outliers.hpp"
#include "modules/filter/voxel_grid.hpp"
#include "tests/bench/box_flat.hpp"

namespace {

template <class Node>
void filter(benchmark::State& state) {
  atrium::Cloud cloud = atrium::bench::box_flat(static_cast<std::size_t>(state.range(0)));
  cloud.normals.clear();
  const auto in = atrium::input(std::move(cloud));
  atrium::Context context;
  for (auto _ : state) benchmark::DoNotOptimize(Node::run({in}, {}, context));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

#define SIZES \
  Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK(filter<atrium::filter::VoxelGrid>)->SIZES;
BENCHMARK(filter<atrium::filter::Outliers>)->SIZES;
