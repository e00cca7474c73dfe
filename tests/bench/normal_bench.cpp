#include <benchmark/benchmark.h>

#include <cmath>

#include "modules/normal/estimate.hpp"
#include "tests/bench/box_flat.hpp"

namespace {

using atrium::normal::Estimate;
using atrium::normal::Method;

/// points/s, and the share of normals that are more than 10° wrong.
void estimate(benchmark::State& state, Method method) {
  atrium::Cloud cloud = atrium::bench::box_flat(static_cast<std::size_t>(state.range(0)));
  const auto truth = std::exchange(cloud.normals, {});
  const auto in = atrium::input(std::move(cloud));
  atrium::Context context;
  atrium::Cloud out;
  Estimate::Params params;
  params.method = method;
  for (auto _ : state) out = Estimate::run({in}, params, context).cloud;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (std::abs(out.normals[i].dot(truth[i])) < std::cos(10 * M_PI / 180)) ++wrong;
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["wrong_%"] = 100.0 * static_cast<double>(wrong) / static_cast<double>(out.size());
}

}  // namespace

#define SIZES \
  Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK_CAPTURE(estimate, voxels, Method::voxels)->SIZES;
BENCHMARK_CAPTURE(estimate, radius, Method::radius)->SIZES;
BENCHMARK_CAPTURE(estimate, neighbours, Method::neighbours)->SIZES;
