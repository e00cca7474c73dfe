// Images of faces from coloured scans, and files of meshes.
#include <benchmark/benchmark.h>

#include <cmath>

#include "modules/io/write_mesh.hpp"
#include "modules/scene/bake_textures.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace atrium;

class Host : public ContextHost {
 public:
  std::filesystem::path output_folder() override { return folder.path(); }
  test::TemporaryFolder folder;
};

void bake(benchmark::State& state) {
  Context context;
  synth::Scan::Params params;
  params.points = state.range(0);
  params.outside = false;
  params.windows = synth::Scan::Windows::open;
  const auto scan = synth::Scan::run({input(synth::Flat::run({}, context).scene)}, params, context);
  const auto cloud = input(scan.cloud);
  const auto mesh = input(scan.mesh);
  for (auto _ : state) benchmark::DoNotOptimize(scene::BakeTextures::run({cloud, mesh}, {}, context));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// A waving coloured sheet of as many triangles.
Mesh sheet(std::int64_t triangles) {
  const auto n = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2));
  Mesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      mesh.vertices.emplace_back(0.01 * i, 0.01 * j, 0.1 * std::sin(0.05 * i) * std::cos(0.03 * j));
      mesh.colours.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), 100});
      if (i == n || j == n) continue;
      const std::uint32_t a = i * (n + 1) + j;
      mesh.triangles.push_back({a, a + n + 1, a + 1});
      mesh.triangles.push_back({a + 1, a + n + 1, a + n + 2});
    }
  return mesh;
}

void write(benchmark::State& state, const std::string& name) {
  const auto host = std::make_shared<Host>();
  Context context(1, host);
  const auto mesh = input(sheet(state.range(0)));
  for (auto _ : state) io::WriteMesh::run({mesh, {}}, {{name}, true}, context);
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(std::filesystem::file_size(host->folder / name)));
}

}  // namespace

#define SIZES \
  Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK(bake)->SIZES;
BENCHMARK_CAPTURE(write, glb, "m.glb")->SIZES;
BENCHMARK_CAPTURE(write, ply, "m.ply")->SIZES;
BENCHMARK_CAPTURE(write, obj, "m.obj")->SIZES;
