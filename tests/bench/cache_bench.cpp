// What the cache costs and saves: values as files (a cloud's points, normals and colours), and sweeps as users run them
// (a new process each time). Budgets: a sweep of 100 variants of 12 nodes that are all known in 1 s, start and table
// included, into a new folder and into the one that it has; a plan of 10,000 variants in 10 s; 50 variants of the last
// node's parameter in 1.3 runs and 50 ends, counted in trace.json.
//
// Set TMPDIR to the disk that is to be measured (/dev/shm: memory).
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "graph/cache/blob.hpp"
#include "modules/types/cloud.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using atrium::Cloud;
using atrium::test::TemporaryFolder;

Cloud cloud_of(std::int64_t size) {
  Cloud cloud;
  const auto n = static_cast<std::size_t>(size);
  for (std::size_t i = 0; i < n; ++i) cloud.points.emplace_back(static_cast<float>(i), 1, 2);
  cloud.normals.resize(n, Eigen::Vector3f::UnitZ());
  cloud.colours.resize(n, {1, 2, 3});
  return cloud;
}

void WriteValue(benchmark::State& state) {
  const TemporaryFolder folder;
  const Cloud cloud = cloud_of(state.range(0));
  const std::string hash = atrium::content_hash(cloud);
  for (auto _ : state) atrium::write_blob(folder / "cloud", *atrium::flat_type<Cloud>(), &cloud, hash);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(atrium::byte_size(cloud)));
}
void ReadValue(benchmark::State& state) {
  const TemporaryFolder folder;
  const Cloud cloud = cloud_of(state.range(0));
  const std::string hash = atrium::content_hash(cloud);
  atrium::write_blob(folder / "cloud", *atrium::flat_type<Cloud>(), &cloud, hash);
  for (auto _ : state)
    benchmark::DoNotOptimize(atrium::read_blob(folder / "cloud", *atrium::flat_type<Cloud>(), hash, {}));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(atrium::byte_size(cloud)));
}
void HashValue(benchmark::State& state) {
  const Cloud cloud = cloud_of(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(atrium::content_hash(cloud));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(atrium::byte_size(cloud)));
}
/// What reading cannot be faster than: its memory is new, too.
void CopyValue(benchmark::State& state) {
  const Cloud cloud = cloud_of(state.range(0));
  for (auto _ : state) {
    Cloud copy = cloud;
    benchmark::DoNotOptimize(copy);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(atrium::byte_size(cloud)));
}
BENCHMARK(WriteValue)->Arg(100'000)->Arg(1'000'000)->Arg(4'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ReadValue)->Arg(100'000)->Arg(1'000'000)->Arg(4'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(CopyValue)->Arg(100'000)->Arg(1'000'000)->Arg(4'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(HashValue)->Arg(100'000)->Arg(1'000'000)->Arg(4'000'000)->Unit(benchmark::kMillisecond);

/// A sweep's folder: a pipeline of 12 nodes (a simulated scan, filters, two files) and its variants.
class Sweep {
 public:
  explicit Sweep(const std::string& variants) {
    std::ofstream base(folder_ / "base.yaml");
    base << "atrium: 1\nnodes:\n  room: {type: synth.room}\n"
            "  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}\n"
            "  f0: {type: filter.voxel_grid, in: {cloud: scan.cloud}, params: {size: 1 cm}}\n";
    for (int i = 1; i < 7; ++i)
      base << "  f" << i << ": {type: filter.voxel_grid, in: {cloud: f" << i - 1 << ".cloud}, params: {size: " << 10 + i
           << " mm}}\n";
    base << "  write: {type: io.write_cloud, in: {cloud: f6.cloud}, params: {path: cloud.ply}}\n"
            "  planes: {type: plane.ransac, in: {cloud: normals.cloud}}\n"
            "  normals: {type: normal.estimate, in: {cloud: f6.cloud}}\n"
            "  vg: {type: io.write_vg, in: {planes: planes.planes}, params: {path: planes.vg}}\n"
            "outputs: {cloud: f6.cloud}\n";
    std::ofstream(folder_ / "sweep.yaml") << "atrium: 1\nsweep: base.yaml\n" << variants;
  }
  bool atrium(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
    arguments.insert(arguments.end(), {"--cache", (folder_ / "cache").string()});
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", 1, 0);
    posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", 1, 0);
    pid_t child = 0;
    int status = -1;
    if (::posix_spawn(&child, argv[0], &quiet, nullptr, argv.data(), environ) == 0) ::waitpid(child, &status, 0);
    posix_spawn_file_actions_destroy(&quiet);
    return status == 0;
  }
  bool run(const std::string& out) const {
    return atrium({"sweep", "run", (folder_ / "sweep.yaml").string(), "--out", (folder_ / out).string()});
  }
  bool plan() const { return atrium({"sweep", "plan", (folder_ / "sweep.yaml").string()}); }
  fs::path file(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

std::string numbers(int count, int first = 1) {
  std::string list;
  for (int i = first; i < first + count; ++i) list += (list.empty() ? "" : ", ") + std::to_string(i);
  return list;
}

void KnownSweepIntoANewFolder(benchmark::State& state) {
  const Sweep sweep("grid: {planes.max_planes: [" + numbers(100) + "]}\n");
  if (!sweep.run("first")) state.SkipWithError("the first run failed");
  int i = 0;
  for (auto _ : state)
    if (!sweep.run("again" + std::to_string(i++))) state.SkipWithError("a run failed");
}
void KnownSweepIntoItsFolder(benchmark::State& state) {
  const Sweep sweep("grid: {planes.max_planes: [" + numbers(100) + "]}\n");
  if (!sweep.run("first")) state.SkipWithError("the first run failed");
  for (auto _ : state)
    if (!sweep.run("first")) state.SkipWithError("a run failed");
}
BENCHMARK(KnownSweepIntoANewFolder)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);
BENCHMARK(KnownSweepIntoItsFolder)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);

/// Nodes that were executed, by the trace: one of each of the 10 before the last two, 50 of those.
void FiftyEnds(benchmark::State& state) {
  for (auto _ : state) {
    const Sweep sweep("grid: {planes.max_planes: [" + numbers(50) + "]}\n");
    if (!sweep.run("out")) state.SkipWithError("the run failed");
    std::ifstream file(sweep.file("out/trace.json"));
    const auto trace = nlohmann::json::parse(file);
    std::map<std::string, int> executed;
    std::map<std::string, double> took;
    for (const auto& event : trace["traceEvents"])
      if (event["ph"] == "X" && event["cat"] != "hash" && event["args"].value("cache", "miss") != "hit") {
        ++executed[event["cat"]];
        took[event["cat"]] += event["dur"].get<double>() * 1e-6;
      }
    double ends = 0;
    double beginning = 0;
    for (const auto& [type, seconds] : took)
      (type == "plane.ransac" || type == "io.write_vg" ? ends : beginning) += seconds;
    state.counters["beginning_nodes"] = 0;
    for (const auto& [type, count] : executed)
      if (type != "plane.ransac" && type != "io.write_vg") state.counters["beginning_nodes"] += count;
    state.counters["planes_nodes"] = executed["plane.ransac"];
    state.counters["beginning_s"] = beginning;
    state.counters["ends_s"] = ends;
  }
}
BENCHMARK(FiftyEnds)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

void PlanTenThousand(benchmark::State& state) {
  std::string sizes;
  for (int i = 0; i < 100; ++i) sizes += (i == 0 ? "" : ", ") + std::to_string(20 + i) + " mm";
  const Sweep sweep("grid: {planes.max_planes: [" + numbers(100) + "], f6.size: [" + sizes + "]}\n");
  for (auto _ : state)
    if (!sweep.plan()) state.SkipWithError("the plan failed");
}
BENCHMARK(PlanTenThousand)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

}  // namespace
