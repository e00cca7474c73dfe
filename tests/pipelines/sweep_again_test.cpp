// `atrium sweep run` into a folder that it was run into before.
#include <csignal>

#include "tests/pipelines/sweep_case.hpp"

namespace atrium::test::sweep_again_test {
namespace {

TEST_F(Sweep, WhatIsDoneIsNotDoneAgainAndGrowingRenamesNothing) {
  sweep("grid: {second.value: [2, 3]}\n");
  const auto before = ids();
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  sweep("grid: {second.value: [4, 2, 3]}\n");
  const auto after = ids();
  EXPECT_EQ(after.size(), 3U);
  for (const auto& id : before) EXPECT_TRUE(after.contains(id));
  const auto result = atrium({"run", "s.yaml", "--out", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("3 variants done (2 before)"), std::string::npos) << result.err;
  EXPECT_EQ(executed(), 4U);
}

TEST_F(Sweep, AVariantWhoseFilesAreGoneRunsAgain) {
  sweep("grid: {second.value: [2, 3]}\n");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  const std::string id = *ids().begin();
  fs::remove(folder / "out/variants" / id / "sub/value.txt");
  const auto result = atrium({"run", "s.yaml", "--out", "out"});
  EXPECT_NE(result.err.find("(1 before)"), std::string::npos) << result.err;
  EXPECT_EQ(read_text(folder / "out/variants" / id / "sub/value.txt"), "1.000000\n");
}

TEST_F(Sweep, AVariantWhoseFilesWereChangedRunsAgain) {
  write_text(folder / "own.yaml", R"(atrium: 1
nodes:
  first: {type: trial.step, params: {value: 1}}
  write: {type: trial.write, in: {value: first.value}, params: {path: value.txt}}
outputs: {first: first.value}
)");
  write_text(folder / "s.yaml", "atrium: 1\nsweep: own.yaml\ngrid: {first.value: [2, 3]}\n");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  const fs::path file = folder / "out/variants" / *ids().begin() / "value.txt";
  const std::string good = read_text(file);
  write_text(file, std::string(good.size(), 'x'));  // of the same size
  const auto result = atrium({"run", "s.yaml", "--out", "out"});
  EXPECT_NE(result.err.find("(1 before)"), std::string::npos) << result.err;
  EXPECT_EQ(read_text(file), good);
}

TEST_F(Sweep, AVariantWhoseInputChangedWhileItRanRunsAgain) {
  const auto scan = [&](const std::string& y) { write_text(folder / "scan.xyz", "0 " + y + " 0\n1 0 0\n0 1 0\n"); };
  write_text(folder / "read.yaml", R"(atrium: 1
nodes:
  scan: {type: io.read_scan, params: {path: scan.xyz}}
  slow: {type: trial.fault, in: {after: scan.cloud}, params: {points: 1, work: 3 s}}
outputs: {sum: slow.sum}
)");
  write_text(folder / "s.yaml", "atrium: 1\nsweep: read.yaml\ngrid: {slow.number: [0]}\nmetrics: {sum: sum}\n");
  scan("5");
  ProcessOptions options;
  options.folder = folder.path();
  options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
  const auto never = std::chrono::steady_clock::time_point::max();
  options.watch = [&, since = never, changed = false](pid_t /*process*/, const std::string& /*err*/) mutable {
    std::error_code none;
    const auto now = std::chrono::steady_clock::now();
    for (const auto& variant : fs::directory_iterator(folder / "out/variants", none))
      if (since == never && fs::exists(variant.path() / "resolved.yaml")) since = now;
    if (changed || since == never || now - since < std::chrono::seconds(1)) return;
    changed = true;
    scan("7");  // of the same size
  };
  const auto first = run_process({ATRIUM_PROGRAM, "sweep", "run", "s.yaml", "--out", "out"}, options);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.err.find("a file that it reads was changed meanwhile"), std::string::npos) << first.err;
  options.watch = nullptr;
  const auto second = run_process({ATRIUM_PROGRAM, "sweep", "run", "s.yaml", "--out", "out"}, options);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.err.find("before)"), std::string::npos) << second.err;
  EXPECT_NE(second.out.find("  7  ok"), std::string::npos) << second.out;
  // And now it is done, until the file is another of the same size and time.
  const auto third = run_process({ATRIUM_PROGRAM, "sweep", "run", "s.yaml", "--out", "out"}, options);
  EXPECT_NE(third.err.find("(1 before)"), std::string::npos) << third.err;
  const auto time = fs::last_write_time(folder / "scan.xyz");
  scan("8");
  fs::last_write_time(folder / "scan.xyz", time);
  EXPECT_NE(run_process({ATRIUM_PROGRAM, "sweep", "run", "s.yaml", "--out", "out"}, options).out.find("  8  ok"),
            std::string::npos);
}

TEST_F(Sweep, GoesOnAfterItWasKilled) {
  sweep("list: {a: {second.value: 2}, b: {second.value: 3}, never: {second.mode: wait}}\nmetrics: {sum: number}\n");
  ProcessOptions options;
  options.folder = folder.path();
  options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
  options.watch = [this, killed = false](pid_t process, const std::string& err) mutable {
    std::size_t done = 0;
    std::error_code ignored;
    for (const auto& variant : fs::directory_iterator(folder / "out/variants", ignored))
      done += fs::exists(variant.path() / "result.json") ? 1 : 0;
    if (killed || done < 2 || err.find("waiting") == std::string::npos) return;
    killed = true;
    ::kill(process, SIGKILL);
  };
  run_process({ATRIUM_PROGRAM, "sweep", "run", "s.yaml", "--out", "out"}, options);
  sweep("list: {a: {second.value: 2}, b: {second.value: 3}, c: {second.value: 4}}\nmetrics: {sum: number}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("3 variants done (2 before)"), std::string::npos) << result.err;
}

TEST_F(Sweep, MeansAreOfWhatIsDone) {
  // Seed 1 and 2 of "good" are done; "stopped" fails at once and ends the sweep.
  sweep(
      "list: {good: {}, stopped: {second.mode: fail}}\nseeds: [1, 2]\nmetrics: {sum: number, time: {seconds: all}}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "-j", "1", "--quiet"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.out.find("good     3 ± 0"), std::string::npos) << result.out;
  const std::string last = result.out.substr(result.out.find("stopped"));
  EXPECT_NE(last.find("2 of 2 failed"), std::string::npos) << result.out;
  EXPECT_EQ(last.find("±"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace atrium::test::sweep_again_test
