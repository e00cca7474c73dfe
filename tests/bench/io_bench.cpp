#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>

#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "tests/bench/box_flat.hpp"

namespace {

/// Writes into the system's temporary folder.
class Host : public atrium::ContextHost {
 public:
  std::filesystem::path output_folder() override { return std::filesystem::temp_directory_path(); }
};

/// A scan on disk (in the page cache, as a file that was just copied is), removed at the end.
struct File {
  File(std::size_t points, const std::string& extension, bool binary, bool columns) {
    atrium::Cloud cloud = atrium::bench::box_flat(points);
    cloud.normals.clear();
    cloud.colours.clear();
    if (columns) {
      cloud.normals.assign(points, Eigen::Vector3f::UnitZ());
      cloud.colours.assign(points, {10, 20, 30});
    }
    const std::string name = "atrium_io_bench_" + std::to_string(::getpid()) + extension;
    atrium::Context context(1, std::make_shared<Host>());
    atrium::io::WriteCloud::run({atrium::input(std::move(cloud))}, {{name}, binary}, context);
    path = (std::filesystem::temp_directory_path() / name).string();
  }
  ~File() { std::filesystem::remove(path); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::string path;
};

void read(benchmark::State& state, const std::string& extension, bool binary, bool columns, double voxel = 0) {
  const File file(static_cast<std::size_t>(state.range(0)), extension, binary, columns);
  atrium::Context context;
  atrium::io::ReadScan::Params params;
  params.path = {{file.path}};
  params.voxel = voxel;
  for (auto _ : state) benchmark::DoNotOptimize(atrium::io::ReadScan::run(params, context));
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(file.path)));
}

}  // namespace

#define SIZES \
  Arg(100000)->Arg(1000000)->Arg(4000000)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK_CAPTURE(read, ply_binary_xyz, ".ply", true, false)->SIZES;
BENCHMARK_CAPTURE(read, ply_binary_xyz_normal_rgb, ".ply", true, true)->SIZES;
BENCHMARK_CAPTURE(read, pcd_binary_xyz_normal_rgb, ".pcd", true, true)->SIZES;
BENCHMARK_CAPTURE(read, ply_ascii_xyz, ".ply", false, false)->SIZES;
BENCHMARK_CAPTURE(read, text_xyz_normal_rgb, ".xyz", false, true)->SIZES;
BENCHMARK_CAPTURE(read, e57_xyz, ".e57", true, false)->SIZES;
BENCHMARK_CAPTURE(read, e57_xyz_normal_rgb, ".e57", true, true)->SIZES;
BENCHMARK_CAPTURE(read, e57_xyz_thinned_to_2_cm, ".e57", true, false, 0.02)->SIZES;
BENCHMARK_CAPTURE(read, las_xyz, ".las", true, false)->SIZES;
BENCHMARK_CAPTURE(read, las_xyz_rgb, ".las", true, true)->SIZES;
BENCHMARK_CAPTURE(read, laz_xyz, ".laz", true, false)->SIZES;
BENCHMARK_CAPTURE(read, laz_xyz_rgb, ".laz", true, true)->SIZES;
