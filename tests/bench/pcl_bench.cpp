// Ours beside PCL's: the table in share/doc/pcl.md.
#include <benchmark/benchmark.h>

#include "modules/filter/outliers.hpp"
#include "modules/filter/voxel_grid.hpp"
#include "modules/normal/estimate.hpp"
#include "modules/pcl/clusters.hpp"
#include "modules/pcl/normals.hpp"
#include "modules/pcl/outliers.hpp"
#include "modules/pcl/ransac.hpp"
#include "modules/pcl/region_growing.hpp"
#include "modules/pcl/voxel_grid.hpp"
#include "modules/plane/ransac.hpp"
#include "modules/plane/region_growing.hpp"
#include "tests/bench/box_flat.hpp"

namespace {

using namespace atrium;  // NOLINT(google-build-using-namespace)

Input<Cloud> flat(benchmark::State& state) {
  Cloud cloud = bench::box_flat(static_cast<std::size_t>(state.range(0)));
  cloud.source.clear();
  cloud.sensors.clear();
  return input(std::move(cloud));
}

template <class Node>
void measure(benchmark::State& state, const typename Node::Params& params) {
  const auto cloud = flat(state);
  Context context;
  for (auto _ : state) {
    if constexpr (requires { Node::run({cloud}, params, context); })
      benchmark::DoNotOptimize(Node::run({cloud}, params, context));
    else
      benchmark::DoNotOptimize(Node::run({cloud}, params));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

template <class Node>
void run(benchmark::State& state) {
  measure<Node>(state, {});
}

/// Normals of the 16 nearest points, by both.
void our_neighbours(benchmark::State& state) {
  normal::Estimate::Params params;
  params.method = normal::Method::neighbours;
  measure<normal::Estimate>(state, params);
}
void pcl_neighbours(benchmark::State& state) {
  measure<pcl_nodes::Normals>(state, {pcl_nodes::Neighbourhood::neighbours, 0.05, 16});
}
/// PCL's loop, ended after as many planes as the flat's rooms have.
void pcl_ransac(benchmark::State& state) {
  pcl_nodes::Ransac::Params params;
  params.max_planes = 24;
  measure<pcl_nodes::Ransac>(state, params);
}
void our_ransac(benchmark::State& state) {
  plane::Ransac::Params params;
  params.max_planes = 24;
  measure<plane::Ransac>(state, params);
}

}  // namespace

#define SIZES \
  Arg(50000)->Arg(200000)->Arg(800000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK(run<filter::VoxelGrid>)->SIZES;
BENCHMARK(run<pcl_nodes::VoxelGrid>)->SIZES;
BENCHMARK(run<filter::Outliers>)->SIZES;
BENCHMARK(run<pcl_nodes::Outliers>)->SIZES;
BENCHMARK(our_neighbours)->SIZES;
BENCHMARK(pcl_neighbours)->SIZES;
BENCHMARK(run<normal::Estimate>)->SIZES;
BENCHMARK(our_ransac)->SIZES;
BENCHMARK(pcl_ransac)->SIZES;
BENCHMARK(run<plane::RegionGrowing>)->SIZES;
BENCHMARK(run<pcl_nodes::RegionGrowing>)->SIZES;
BENCHMARK(run<pcl_nodes::Clusters>)->SIZES;
