#include <benchmark/benchmark.h>

#include "modules/metric/distance.hpp"
#include "modules/metric/faces.hpp"
#include "modules/metric/structure.hpp"
#include "modules/metric/validity.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"

namespace {

using namespace atrium;  // NOLINT(google-build-using-namespace)

struct Case {
  Input<Cloud> cloud;
  Input<Mesh> structure;  // the true faces: some hundred triangles
  Input<Mesh> detailed;   // everything that reflects, each triangle cut until there are 100,000
};

Mesh detailed_mesh(const SimulatedScene& scene, std::size_t triangles) {
  Mesh mesh;
  mesh.vertices = scene.vertices;
  mesh.triangles = scene.triangles;
  while (mesh.triangles.size() < triangles) {
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
      const Eigen::Vector3d ab = (mesh.vertices[a] + mesh.vertices[b]) / 2,
                            bc = (mesh.vertices[b] + mesh.vertices[c]) / 2,
                            ca = (mesh.vertices[c] + mesh.vertices[a]) / 2;
      mesh.vertices.insert(mesh.vertices.end(), {ab, bc, ca});
      finer.insert(finer.end(),
                   {{a, next, next + 2}, {next, b, next + 1}, {next + 2, next + 1, c}, {next, next + 1, next + 2}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

const Case& scanned(std::int64_t points) {
  static std::map<std::int64_t, Case> cases;
  auto [place, added] = cases.try_emplace(points);
  if (added) {
    Context context;
    const auto scene = input(synth::Flat::run({}, context).scene);
    synth::Scan::Params params;
    params.points = points;
    params.outside = false;
    params.windows = synth::Scan::Windows::open;
    auto out = synth::Scan::run({scene}, params, context);
    place->second = {input(std::move(out.cloud)), input(std::move(out.mesh)), input(detailed_mesh(*scene, 100000))};
  }
  return place->second;
}

void distance(benchmark::State& state, Input<Mesh> Case::*mesh) {
  const Case& c = scanned(state.range(0));
  Context context;
  for (auto _ : state) benchmark::DoNotOptimize(metric::Distance::run({c.cloud, c.*mesh, {}, {}}, {}, context));
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["triangles"] = static_cast<double>((c.*mesh)->triangles.size());
}

void structure(benchmark::State& state) {
  const Case& c = scanned(100000);
  Context context;
  for (auto _ : state) benchmark::DoNotOptimize(metric::Structure::run({c.structure, {}, c.structure}, {}, context));
}

void faces(benchmark::State& state) {
  const Case& c = scanned(100000);
  Context context;
  for (auto _ : state) benchmark::DoNotOptimize(metric::Faces::run({c.detailed}));
}

// Everything that reflects in the flat, cut into about as many triangles as asked for.
void validity(benchmark::State& state) {
  Context context;
  const auto scene = synth::Flat::run({}, context).scene;
  Mesh mesh = detailed_mesh(scene, static_cast<std::size_t>(state.range(0)));
  mesh.triangles.resize(static_cast<std::size_t>(state.range(0)));
  const auto cut = input(std::move(mesh));
  for (auto _ : state) benchmark::DoNotOptimize(metric::Validity::run({cut}, {}, context));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

#define SIZES \
  Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK_CAPTURE(distance, structure, &Case::structure)->SIZES;
BENCHMARK_CAPTURE(distance, detailed, &Case::detailed)->SIZES;
BENCHMARK(structure)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(faces)->Unit(benchmark::kMillisecond);
BENCHMARK(validity)
    ->Arg(100000)
    ->Arg(500000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
