// The cache as users meet it: what is known is not computed again, and nothing that happens to it makes a result wrong.
#include <array>
#include <csignal>
#include <map>
#include <set>
#include <thread>

#include "graph/api/random.hpp"
#include "tests/pipelines/cache_of_runs.hpp"

namespace atrium::test::cache_test {
namespace {

TEST_F(CacheOfRuns, ASecondRunComputesNothingAndShowsTheSame) {
  const auto cold = atrium({"run", "p.yaml", "--out", "cold"});
  ASSERT_EQ(cold.exit_code, 0) << cold.err;
  EXPECT_EQ(uses("cold"), "first:miss second:miss third:miss write:miss cloud:miss");
  const auto warm = atrium({"run", "p.yaml", "--out", "warm"});
  ASSERT_EQ(warm.exit_code, 0) << warm.err;
  EXPECT_EQ(uses("warm"), "first:hit second:hit third:hit write:hit cloud:hit");
  EXPECT_EQ(shown("warm"), shown("cold"));
  EXPECT_EQ(warm.out, cold.out);
  EXPECT_NE(warm.err.find("warning: write: only one number\n"), std::string::npos) << warm.err;
  EXPECT_NE(warm.err.find("5 nodes done (5 by the cache)"), std::string::npos) << warm.err;
  EXPECT_EQ(manifest("warm")["cache"]["loaded_bytes"], 0);
  const json third = manifest("warm")["nodes"][2]["cache"];
  EXPECT_GE(third["computing_wall_seconds"], 0.05);
  EXPECT_EQ(third["key"], manifest("cold")["nodes"][2]["cache"]["key"]);
  expect_sound();
}

TEST_F(CacheOfRuns, IsSwitchedOff) {
  atrium({"run", "p.yaml", "--out", "cold"});
  atrium({"run", "p.yaml", "--out", "off", "--no-cache"});
  EXPECT_EQ(uses("off"), "first:off second:off third:off write:off cloud:off");
  EXPECT_EQ(shown("off"), shown("cold"));
  atrium({"run", "p.yaml", "--out", "other", "--cache", "elsewhere"});
  EXPECT_EQ(uses("other"), "first:miss second:miss third:miss write:miss cloud:miss");
}

TEST_F(CacheOfRuns, AChangeRunsWhatDependsOnItAndWhySaysSo) {
  atrium({"run", "p.yaml", "--out", "cold"});
  atrium({"run", "p.yaml", "--out", "changed", "-s", "second.number=4"});
  EXPECT_EQ(uses("changed"), "first:hit second:miss third:miss write:miss cloud:miss");
  const auto second = atrium({"why", "changed", "second"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(second.out.find("  number: 1 → 4\n"), std::string::npos) << second.out;
  const auto third = atrium({"why", "changed", "third"});
  EXPECT_NE(third.out.find("  after: another value (from second.cloud: ask about that node)\n"), std::string::npos)
      << third.out;
  EXPECT_NE(atrium({"why", "changed", "first"}).out.find("first was cached: computed 20"), std::string::npos);
  const auto as_json = json::parse(atrium({"why", "changed", "second", "--json"}).out);
  EXPECT_EQ(as_json["nearest"]["differences"], json::parse(R"([{"field": "number", "then": "1", "now": "4"}])"));
  EXPECT_EQ(atrium({"why", "changed", "secnd"}).exit_code, 1);
  EXPECT_EQ(atrium({"why", "nowhere", "second"}).exit_code, 1);
}

TEST_F(CacheOfRuns, AFileThatIsReadCountsByItsContents) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  write_text(folder / "scan.xyz", points);
  write_text(folder / "r.yaml", R"(atrium: 1
vars: {scan: scan.xyz}
nodes:
  scan: {type: io.read_scan, params: {path: "${scan}"}}
outputs: {scan: scan.cloud}
)");
  ASSERT_EQ(atrium({"run", "r.yaml", "--out", "1"}).exit_code, 0);
  fs::last_write_time(folder / "scan.xyz", fs::file_time_type::clock::now());
  atrium({"run", "r.yaml", "--out", "2"});
  EXPECT_EQ(uses("2"), "scan:hit");
  fs::create_directories(folder / "elsewhere");
  write_text(folder / "elsewhere/scan.xyz", points);
  atrium({"run", "r.yaml", "--out", "3", "-s", "scan=elsewhere/scan.xyz"});
  EXPECT_EQ(uses("3"), "scan:hit");
  // The same size, and the time set back.
  const auto time = fs::last_write_time(folder / "scan.xyz");
  write_text(folder / "scan.xyz", "0 0 0\n2 0 0\n0 1 0\n");
  fs::last_write_time(folder / "scan.xyz", time);
  atrium({"run", "r.yaml", "--out", "4"});
  EXPECT_EQ(uses("4"), "scan:miss");
}

TEST_F(CacheOfRuns, ARunThatIsKilledAtAnyMomentGoesOnToTheSameResult) {
  ASSERT_EQ(atrium({"run", "p.yaml", "--out", "undisturbed", "--no-cache"}).exit_code, 0);
  Random random(5);
  for (int round = 0; round < 4; ++round) {
    for (int i = 0; i < 3; ++i) {
      ProcessOptions options;
      const auto start = std::chrono::steady_clock::now();
      const auto end = start + std::chrono::duration<double>(random.uniform(0.02, 0.4));
      options.watch = [&](pid_t process, const std::string& /*err*/) {
        if (std::chrono::steady_clock::now() > end) ::kill(process, SIGKILL);
      };
      atrium({"run", "p.yaml", "--out", "killed"}, options);
    }
    ASSERT_EQ(atrium({"run", "p.yaml", "--out", "killed"}).exit_code, 0);
    EXPECT_EQ(shown("killed"), shown("undisturbed"));
    expect_sound();
    fs::remove_all(folder / "cache" / std::array{"records", "values", "files"}[static_cast<std::size_t>(round) % 3]);
  }
}

TEST_F(CacheOfRuns, ASweepThatIsKilledAtAnyMomentGoesOnToTheSameTable) {
  write_text(folder / "s.yaml",
             "atrium: 1\nsweep: p.yaml\ngrid: {first.number: [1, 2], third.number: [1, 2]}\n"
             "metrics: {sum: sum}\n");
  ASSERT_EQ(atrium({"sweep", "run", "s.yaml", "--out", "undisturbed", "--no-cache"}).exit_code, 0);
  const std::string table = read_text(folder / "undisturbed/table.csv");
  Random random(7);
  for (int round = 0; round < 2; ++round) {
    const std::string out = "killed" + std::to_string(round);
    for (int i = 0; i < 4; ++i) {
      const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(random.uniform(0.02, 0.5));
      ProcessOptions options;
      options.watch = [&](pid_t process, const std::string& /*err*/) {
        if (std::chrono::steady_clock::now() > end) ::kill(process, SIGKILL);
      };
      atrium({"sweep", "run", "s.yaml", "--out", out}, options);
    }
    ASSERT_EQ(atrium({"sweep", "run", "s.yaml", "--out", out}).exit_code, 0);
    EXPECT_EQ(read_text(folder / out / "table.csv"), table);
    for (const auto& variant : fs::directory_iterator(folder / "undisturbed/variants"))
      for (const char* file : {"cloud.ply", "sub/value.txt"})
        EXPECT_EQ(read_text(folder / out / "variants" / variant.path().filename() / file),
                  read_text(variant.path() / file));
    expect_sound();
  }
}

TEST_F(CacheOfRuns, TwoProcessesShareOne) {
  std::vector<std::thread> threads;
  std::array<int, 3> codes{};
  for (std::size_t i = 0; i < codes.size(); ++i)
    threads.emplace_back([&, i] {
      codes[i] = atrium({"run", "p.yaml", "--out", "run" + std::to_string(i)}).exit_code;
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(codes, (std::array<int, 3>{0, 0, 0}));
  for (const char* run : {"run1", "run2"}) EXPECT_EQ(shown(run), shown("run0"));
  expect_sound();
}

TEST_F(CacheOfRuns, NodesThatMisbehaveLeaveACacheThatWorks) {
  const auto with = [&](const std::string& mode) {
    return std::vector<std::string>{"run", "p.yaml", "--out", mode, "--quiet", "-s", "third.mode=" + mode};
  };
  EXPECT_GE(atrium(with("abort")).exit_code, 128);
  const auto hang = [&] {
    ProcessOptions options;
    options.watch = [sent = false](pid_t process, const std::string& err) mutable {
      if (!sent && err.find("hanging") != std::string::npos) ::kill(process, SIGINT);
      sent = sent || err.find("hanging") != std::string::npos;
    };
    return atrium({"run", "p.yaml", "--out", "hang", "-s", "third.mode=hang"}, options);
  }();
  EXPECT_EQ(hang.exit_code, 130) << hang.err;
  EXPECT_EQ(uses("hang").find("second:miss"), std::string::npos) << uses("hang");
  EXPECT_EQ(atrium(with("flood")).exit_code, 0);
  EXPECT_EQ(atrium(with("nan")).exit_code, 0);
  const auto cold = shown("nan");
  const auto nan = atrium(with("nan"));
  EXPECT_EQ(uses("nan"), "first:hit second:hit third:hit write:hit cloud:hit");
  EXPECT_EQ(shown("nan"), cold);
  EXPECT_NE(nan.out.find("nan"), std::string::npos) << nan.out;
  expect_sound();
}

TEST_F(CacheOfRuns, ANodeThatIsNotDeterministicIsFoundOutAndTheRunGoesOn) {
  // Its value is not worth keeping, so it is made again when a later node needs it, and differs.
  write_text(folder / "f.yaml", R"(atrium: 1
nodes:
  fickle: {type: trial.fault, params: {points: 10, mode: fickle}}
  after: {type: trial.fault, in: {after: fickle.cloud}}
  more: {type: trial.fault, in: {after: fickle.cloud}}
outputs: {sum: after.sum, more: more.sum}
)");
  ASSERT_EQ(atrium({"run", "f.yaml", "--out", "r"}).exit_code, 0);
  const auto result = atrium({"run", "f.yaml", "--out", "r", "-s", "after.number=3"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("fickle: run again, it gave another 'cloud' than before"), std::string::npos) << result.err;
  EXPECT_EQ(uses("r"), "fickle:miss after:miss more:miss");
  EXPECT_EQ(manifest("r")["nodes"][0]["warnings"].size(), 1U);
}

TEST_F(CacheOfRuns, AGrowingSweepRunsWhatIsNew) {
  const auto sweep = [&](const std::string& values, const std::string& out) {
    write_text(folder / "s.yaml", "atrium: 1\nsweep: p.yaml\ngrid: {third.number: [" + values + "]}\n");
    const auto result = atrium({"sweep", "run", "s.yaml", "--out", out});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::size_t run = 0;
    const json all = manifest(out);
    for (const auto& node : all["nodes"]) run += node["cache"]["result"] == "miss" ? 1 : 0;
    return run;
  };
  EXPECT_EQ(sweep("1, 2", "a"), 8U);
  EXPECT_EQ(sweep("1, 2, 3", "b"), 3U);  // in another folder: nothing is there but the cache
  EXPECT_EQ(sweep("3, 1, 2", "c"), 0U);
  EXPECT_EQ(read_text(folder / "c/table.csv").size(), read_text(folder / "b/table.csv").size());
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "c"))
    files += entry.path().filename() == "cloud.ply" || entry.path().filename() == "value.txt" ? 1 : 0;
  EXPECT_EQ(files, 6U);
}

TEST_F(CacheOfRuns, WhyKnowsEveryNodeOfEveryVariant) {
  const auto sweep = [&](const std::string& values) {
    write_text(folder / "s.yaml", "atrium: 1\nsweep: p.yaml\ngrid: {third.number: [" + values + "]}\n");
    const auto result = atrium({"sweep", "run", "s.yaml", "--out", "out"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::set<std::string> ids;
    for (const auto& entry : fs::directory_iterator(folder / "out/variants")) ids.insert(entry.path().filename());
    return ids;
  };
  const auto before = sweep("1, 2");
  for (const auto& id : before)
    for (const char* node : {"first", "third"}) {  // `first` is shared
      const auto result = atrium({"why", "out", id + "/" + node});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_TRUE(result.out.starts_with(id + "/" + node + " was run: not computed before\n")) << result.out;
    }
  const auto after = sweep("1, 2, 3");
  for (const auto& id : after) {
    const auto result = atrium({"why", "out", id + "/second", "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["result"], before.contains(id) ? "miss" : "hit");
  }
  EXPECT_NE(atrium({"why", "out", *after.begin() + "/secnd"}).err.find("did you mean 'second'"), std::string::npos);
  EXPECT_NE(atrium({"why", "out", "nobody/second"}).err.find("no variant 'nobody'"), std::string::npos);
  EXPECT_NE(atrium({"why", "out", "second"}).err.find("VARIANT/NODE"), std::string::npos);
}

TEST_F(CacheOfRuns, APlanSaysWhatIsKnownAndWhatTheRestCosts) {
  const auto plan = [&](const std::string& values, const std::vector<std::string>& more = {}) {
    write_text(folder / "s.yaml", "atrium: 1\nsweep: p.yaml\ngrid: {third.number: [" + values + "]}\n");
    std::vector<std::string> arguments{"sweep", "plan", "s.yaml", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = atrium(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  };
  const json before = plan("1, 2");
  EXPECT_EQ(before["nodes_known"], 0);
  EXPECT_EQ(before["nodes_to_run"], 8);
  EXPECT_EQ(before["nodes_of_unknown_cost"], 8);
  ASSERT_EQ(atrium({"sweep", "run", "s.yaml", "--out", "a"}).exit_code, 0);
  const json after = plan("1, 2, 3");
  EXPECT_EQ(after["nodes_known"], 8);
  EXPECT_EQ(after["nodes_to_run"], 3);
  EXPECT_EQ(after["nodes_of_unknown_cost"], 0);
  EXPECT_EQ(after["variants"][0]["nodes_to_run"], 0);
  EXPECT_EQ(after["variants"][2]["nodes_to_run"], 3);
  EXPECT_GE(after["seconds"], 0.05);
  EXPECT_EQ(plan("1, 2", {"--no-cache"})["nodes_to_run"], 8);
  EXPECT_EQ(plan("1, 2", {"--out", "a"})["variants"][1]["done"], true);
}

}  // namespace
}  // namespace atrium::test::cache_test
