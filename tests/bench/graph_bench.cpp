// What checking costs: the paper's pipeline as the command line does it (a new process, plugins loaded), generated
// files of up to 10,000 nodes, and the paths of a large file's mistakes. Budgets: `atrium check pipelines/paper.yaml`
// below 50 ms, 10,000 nodes below 1 s.
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "graph/pipeline/pipeline.hpp"
#include "tests/graph/test_nodes.hpp"

namespace {

using namespace atrium;

/// A chain of `size` nodes with parameters, branches and units, as a generator or a sweep would write it.
std::filesystem::path generated_file(std::int64_t size, bool with_mistakes) {
  const auto file = std::filesystem::temp_directory_path() / ("atrium-bench-" + std::to_string(::getpid()) + ".yaml");
  std::ofstream out(file);
  out << "atrium: 1\nvars: {distance: 2 cm}\nnodes:\n  n0: {type: test.make}\n";
  for (std::int64_t i = 1; i < size; ++i)
    out << "  n" << i << ": {type: test.find, in: {cloud: n" << (i - 1) << (i == 1 ? ".cloud" : ".rest")
        << "}, params: {" << (with_mistakes ? "distnce" : "distance") << ": \"${distance}\", angle: " << i % 90
        << " deg, max_planes: 70, method: hough, box: [1 m, 20 cm, 3 mm]}}\n";
  out << "outputs: {planes: n" << size - 1 << ".planes}\n";
  return file;
}

void check_generated(benchmark::State& state, bool with_mistakes) {
  const auto file = generated_file(state.range(0), with_mistakes);
  Registry registry{std::vector<std::filesystem::path>{}};
  test::add_test_nodes(registry);
  for (auto _ : state) {
    const LoadResult result = load_pipeline(file, {}, registry);
    if (result.errors.empty() == with_mistakes) state.SkipWithError("the file was not checked as expected");
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  std::filesystem::remove(file);
}
void CheckGenerated(benchmark::State& state) { check_generated(state, false); }
void CheckGeneratedWithMistakes(benchmark::State& state) { check_generated(state, true); }
BENCHMARK(CheckGenerated)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(CheckGeneratedWithMistakes)->Arg(10000)->Unit(benchmark::kMillisecond);

/// A new process each time: start, plugins, checks, end.
void run_program(benchmark::State& state, std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", 1, 0);
  for (auto _ : state) {
    pid_t child = 0;
    int status = -1;
    if (::posix_spawn(&child, argv[0], &quiet, nullptr, argv.data(), environ) == 0) ::waitpid(child, &status, 0);
    if (status != 0) state.SkipWithError("the program failed");
  }
  posix_spawn_file_actions_destroy(&quiet);
}
void StartProgram(benchmark::State& state) { run_program(state, {ATRIUM_PROGRAM, "--help"}); }
void CheckPaper(benchmark::State& state) {
  run_program(state, {ATRIUM_PROGRAM, "check", ATRIUM_SOURCE_DIR "/pipelines/paper.yaml"});
}
BENCHMARK(StartProgram)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(CheckPaper)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
