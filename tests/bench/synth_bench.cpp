#include <benchmark/benchmark.h>

#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"

namespace {

using atrium::synth::Flat;
using atrium::synth::Scan;

void flat(benchmark::State& state) {
  atrium::Context context;
  for (auto _ : state) benchmark::DoNotOptimize(Flat::run({}, context));
}

void scan(benchmark::State& state, Scan::Pattern pattern) {
  atrium::Context context;
  const auto scene = atrium::input(Flat::run({}, context).scene);
  Scan::Params params;
  params.points = state.range(0);
  params.pattern = pattern;
  for (auto _ : state) benchmark::DoNotOptimize(Scan::run({scene}, params, context));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

#define SIZES \
  Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK(flat)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan, spherical, Scan::Pattern::spherical)->SIZES;
BENCHMARK_CAPTURE(scan, uniform_area, Scan::Pattern::uniform_area)->SIZES;
BENCHMARK_CAPTURE(scan, hand_held, Scan::Pattern::hand_held)->SIZES;
