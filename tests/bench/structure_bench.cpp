// The steps from planes to clipped meshes, over an L-shaped room of so many points.
#include <benchmark/benchmark.h>

#include <cmath>

#include "modules/align/xy_plane.hpp"
#include "modules/align/z_axis.hpp"
#include "modules/estimate/adjacency.hpp"
#include "modules/estimate/plane_meshes.hpp"
#include "modules/refine/mesh_clipping.hpp"
#include "modules/segment/structure.hpp"
#include "tests/support/rooms.hpp"

namespace {

using namespace atrium;  // NOLINT(google-build-using-namespace)

PlanePrimitives room(benchmark::State& state) {
  constexpr double area = 97;  // square metres of floor, ceiling and walls
  test::Rooms rooms;
  rooms.spacing = std::sqrt(area / static_cast<double>(state.range(0)));
  rooms.noise = 0.008;
  rooms.floor(0, 0, 6, 5, 0, test::in_l).ceiling(0, 0, 6, 5, 2.5, test::in_l).walls(test::l_outline());
  Transform turn;
  turn.rotation = Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.05, 0.1, 1).normalized()).toRotationMatrix();
  return transformed(rooms.planes(), turn);
}

struct Steps {
  Input<PlanePrimitives> planes, aligned;
  Input<Structure> structure;
  Input<PlaneMeshes> meshes;
  Input<Adjacency> adjacency;

  explicit Steps(benchmark::State& state) : planes(input(room(state))) {
    Context context;
    auto upright = align::ZAxis::run({planes, {}}, {}, context);
    aligned = align::XyPlane::run({input(std::move(upright.planes)), {}}, {}, context).planes;
    structure = input(segment::Structure::run({aligned}, {}, context).structure);
    meshes = input(estimate::PlaneMeshes::run({structure}, {}, context).meshes);
    adjacency = input(estimate::Adjacency::run({meshes}, {}, context).adjacency);
  }
};

template <class Work>
void measure(benchmark::State& state, const Work& work) {
  const Steps steps(state);
  Context context;
  for (auto _ : state) work(steps, context);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(steps.planes->cloud->size()));
}

void align_both(benchmark::State& state) {
  measure(state, [](const Steps& steps, Context& context) {
    auto upright = align::ZAxis::run({steps.planes, {}}, {}, context);
    benchmark::DoNotOptimize(align::XyPlane::run({input(std::move(upright.planes)), {}}, {}, context));
  });
}
void segment_structure(benchmark::State& state) {
  measure(state, [](const Steps& steps, Context& context) {
    benchmark::DoNotOptimize(segment::Structure::run({steps.aligned}, {}, context));
  });
}
void estimate_plane_meshes(benchmark::State& state) {
  measure(state, [](const Steps& steps, Context& context) {
    benchmark::DoNotOptimize(estimate::PlaneMeshes::run({steps.structure}, {}, context));
  });
}
void refine_mesh_clipping(benchmark::State& state) {
  measure(state, [](const Steps& steps, Context& context) {
    benchmark::DoNotOptimize(refine::MeshClipping::run({steps.meshes, steps.adjacency, steps.structure}, {}, context));
  });
}

}  // namespace

#define SIZES \
  Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK(align_both)->SIZES;
BENCHMARK(segment_structure)->SIZES;
BENCHMARK(estimate_plane_meshes)->SIZES;
BENCHMARK(refine_mesh_clipping)->SIZES;
