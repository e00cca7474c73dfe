// `atrium sweep run --isolate`: what happens to a process costs its variant only, and changes nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class Isolated : public testing::Test {
 protected:
  Isolated() {
    write_text(folder / "base.yaml", R"(atrium: 1
summary: A beginning that variants share, and what they do with it.
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  look: {type: render.snapshot, in: {cloud: scan.cloud}, params: {path: look.png, width: 80, height: 60}}
  first: {type: trial.fault, in: {after: scan.cloud}, params: {points: 1000, work: 0.02 s}}
  second: {type: trial.fault, in: {after: first.cloud}, params: {number: 2}}
  random: {type: trial.step, in: {after: first.sum}, params: {value: 0}}
  write: {type: trial.write, in: {value: second.sum}, params: {path: sub/value.txt}}
  cloud: {type: io.write_cloud, in: {cloud: second.cloud}, params: {path: cloud.ply}}
outputs: {sum: second.sum, random: random.value, text: random.text}
)");
  }
  void sweep(const std::string& rest) { write_text(folder / "s.yaml", "atrium: 1\nsweep: base.yaml\n" + rest); }
  ProcessResult atrium(std::vector<std::string> arguments, ProcessOptions options = {}) {
    arguments.insert(arguments.begin(), {ATRIUM_PROGRAM, "sweep", "run", "s.yaml"});
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
    return run_process(arguments, options);
  }
  ProcessResult isolated(const std::string& out, std::vector<std::string> more = {}, ProcessOptions options = {}) {
    more.insert(more.begin(), {"--isolate", "--out", out, "--cache", "cache-" + out});
    return atrium(std::move(more), std::move(options));
  }
  /// By label.
  std::map<std::string, json> results(const std::string& out) {
    std::map<std::string, json> found;
    for (const auto& variant : fs::directory_iterator(folder / out / "variants")) {
      const fs::path file = variant.path() / "result.json";
      if (!fs::exists(file)) continue;
      json result = json::parse(read_text(file));
      found[result.at("variant")] = result;
    }
    return found;
  }
  /// All that a sweep leaves but times, memory and what is said of the cache: by file.
  std::map<std::string, std::string> left(const std::string& out) {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder / out)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().lexically_relative(folder / out).string();
      const std::string file = entry.path().filename().string();
      if (file == "variant.json" || file == "trace.json" || file == "worker.log") continue;
      found[name] = file == "sheet.png" ? "" : read_text(entry.path());  // its stamp names the folder
      if (file != "result.json" && file != "manifest.json") continue;
      json all = json::parse(found[name]);
      for (const char* key :
           {"started", "wall_seconds", "cpu_seconds", "peak_memory", "hash_seconds", "cache", "threads"})
        all.erase(key);
      for (auto& node : all["nodes"])
        for (const char* key : {"wall_seconds", "cpu_seconds", "peak_memory", "known", "cache"}) node.erase(key);
      found[name] = all.dump(1);
    }
    return found;
  }
  static void expect_same(const std::map<std::string, std::string>& left,
                          const std::map<std::string, std::string>& right) {
    EXPECT_EQ(left.size(), right.size());
    for (const auto& [file, text] : right)
      if (left.contains(file)) EXPECT_EQ(left.at(file), text) << file;
  }
  /// Processes that have the test's folder in their command line.
  std::size_t processes() {
    std::size_t found = 0;
    std::error_code failure;
    for (fs::directory_iterator at("/proc", failure), end; !failure && at != end; at.increment(failure)) {
      std::ifstream file(at->path() / "cmdline");
      const std::string line((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      found += line.find(folder.path().string()) != std::string::npos ? 1 : 0;
    }
    return found;
  }

  TemporaryFolder folder;
};

TEST_F(Isolated, LeavesTheSameBytes) {
  sweep(
      "grid: {second.number: [2, 3, 4]}\nseeds: [1, 2]\n"
      "metrics: {sum: sum, random: random, text: text}\npictures: {sheet.png: look.png}\n");
  ASSERT_EQ(atrium({"--out", "together", "--no-cache", "-q"}).exit_code, 0);
  const auto expected = left("together");
  EXPECT_GT(expected.size(), 6U * 5U);
  for (const auto& [out, more] : std::map<std::string, std::vector<std::string>>{
           {"one", {"-j", "1"}}, {"three", {"-j", "3"}}, {"none", {"--no-cache"}}}) {
    auto arguments = more;
    arguments.insert(arguments.end(), {"--isolate", "--out", out, "-q", "--cache", "cache-" + out});
    const auto result = atrium(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    expect_same(left(out), expected);
    EXPECT_FALSE(fs::exists(folder / out / "work"));
  }
  // What one way of running has done, the other takes as done, and nothing is left to do; nor if the cache has all.
  EXPECT_NE(isolated("together").err.find("(6 before)"), std::string::npos);
  EXPECT_NE(atrium({"--out", "one"}).err.find("(6 before)"), std::string::npos);
  const auto known = atrium({"--isolate", "--out", "known", "--cache", "cache-three"});
  expect_same(left("known"), expected);
  EXPECT_EQ(known.err.find("0 of"), std::string::npos) << known.err;
}

TEST_F(Isolated, WhatVariantsShareIsComputedOnce) {
  sweep("grid: {second.number: [2, 3, 4, 5]}\n");
  const auto result = isolated("out", {"-j", "4"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json manifest = json::parse(read_text(folder / "out/manifest.json"));
  EXPECT_EQ(manifest.at("nodes").size(), 5U + 4U * 3U);
  for (const auto& node : manifest.at("nodes")) EXPECT_EQ(node.at("cache").at("result"), "miss") << node;
  std::size_t known = 0;
  for (const auto& [label, variant] : results("out"))
    for (const auto& node : variant.at("nodes")) known += node.value("known", false) ? 1 : 0;
  EXPECT_EQ(known, 4U * 5U);
}

struct Crash {
  std::string name;
  std::vector<std::string> options;
  std::string says;
};
class IsolatedCrash : public Isolated, public testing::WithParamInterface<Crash> {};
TEST_P(IsolatedCrash, CostsItsVariantOnly) {
  sweep("list: {a: {}, bad: {second.mode: " + GetParam().name + "}, b: {second.number: 5}}\nmetrics: {sum: sum}\n");
  const auto result = isolated("out", GetParam().options);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.out.find("bad         –  crashed: " + GetParam().says + " in node second\n"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("a        5100  ok\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("b        8100  ok\n"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("2 variants done, 1 crashed"), std::string::npos) << result.err;
  const json bad = results("out").at("bad");
  EXPECT_EQ(bad.at("status"), "crashed");
  std::map<std::string, std::string> status;
  for (const auto& node : bad.at("nodes")) status[node.at("node")] = node.at("status");
  EXPECT_EQ(status["first"], "ok");
  EXPECT_EQ(status["second"], "failed");
  EXPECT_EQ(status["cloud"], "skipped");
  EXPECT_EQ(processes(), 0U);
  // It is tried again the next time, the others are not.
  const auto again = isolated("out", GetParam().options);
  EXPECT_EQ(again.exit_code, 4);
  EXPECT_NE(again.err.find("2 variants done (2 before), 1 crashed"), std::string::npos) << again.err;
}
INSTANTIATE_TEST_SUITE_P(All, IsolatedCrash,
                         testing::Values(Crash{"segv", {}, "signal 11 (SIGSEGV)"},
                                         Crash{"abort", {"-j", "1"}, "signal 6 (SIGABRT)"},
                                         Crash{"exit", {}, "exit code 7"},
                                         Crash{"hang", {"--timeout", "1.5"}, "ended after 1.5 s (--timeout)"}),
                         [](const auto& crash) { return crash.param.name; });

TEST_F(Isolated, AVariantThatNeedsTooMuchMemoryIsEnded) {
  sweep("list: {a: {}, bad: {second.mode: devour}, b: {second.number: 5}}\nmetrics: {sum: sum}\n");
  const auto result = isolated("out", {"--mem", "300 MB", "-j", "3"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.out.find("bad         –  crashed: ended when it held "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("of memory (--mem) in node second\n"), std::string::npos) << result.out;
  EXPECT_EQ(results("out").at("a").at("status"), "ok");
  EXPECT_EQ(results("out").at("b").at("status"), "ok");
}

TEST_F(Isolated, ACrashInWhatIsSharedCostsThoseThatShareIt) {
  sweep("list: {good: {}, bad: {first.mode: segv}}\ngrid: {second.number: [2, 3]}\nmetrics: {sum: sum}\n");
  const auto result = isolated("out");
  EXPECT_EQ(result.exit_code, 4) << result.err;
  const auto found = results("out");
  for (const char* number : {"2", "3"}) {
    EXPECT_EQ(found.at(std::string("good, second.number = ") + number).at("status"), "ok");
    const json& bad = found.at(std::string("bad, second.number = ") + number);
    EXPECT_EQ(bad.at("message"), "signal 11 (SIGSEGV) in node first");
  }
  // What else is shared was computed once all the same.
  const json manifest = json::parse(read_text(folder / "out/manifest.json"));
  for (const auto& node : manifest.at("nodes"))
    if (node.at("status") == "ok") EXPECT_EQ(node.at("cache").at("result"), "miss") << node;
}

TEST_F(Isolated, NodesThatFailOrFloodOrGiveNoNumber) {
  sweep(
      "list: {nan: {second.mode: nan}, flood: {second.mode: flood}, failed: {random.mode: fail}}\nmetrics: {sum: "
      "sum}\n");
  const auto result = isolated("out");
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_EQ(result.out,
            "variant   sum  status\n"
            "nan       nan  ok\n"
            "flood    5100  ok\n"
            "failed      –  failed: random: told to fail\n");
  EXPECT_NE(result.err.find("/random (trial.step): told to fail\n  help: do not tell it\n"), std::string::npos)
      << result.err;
  EXPECT_LT(result.err.size(), 10'000U);
  for (const auto& variant : fs::directory_iterator(folder / "out/variants")) {
    if (json::parse(read_text(variant.path() / "result.json")).at("variant") != "flood") continue;
    const std::string log = read_text(variant.path() / "worker.log");
    EXPECT_GT(log.size(), 2'000'000U);
    EXPECT_LT(log.size(), 3'000'000U);
    EXPECT_NE(log.find("bytes are left out here]"), std::string::npos);
  }
}

TEST_F(Isolated, EndsWhenEnoughHaveFailed) {
  sweep("set: {second.mode: segv}\ngrid: {second.number: [1, 2, 3, 4, 5, 6]}\nmetrics: {sum: sum}\n");
  const auto result = isolated("out", {"-j", "1", "--max-fail", "2"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("0 variants done, 2 crashed, 4 cancelled"), std::string::npos) << result.err;
}

TEST_F(Isolated, IsCancelled) {
  sweep("list: {a: {}, never: {second.mode: hang}}\nmetrics: {sum: sum}\n");
  ProcessOptions options;
  options.watch = [sent = false](pid_t process, const std::string& err) mutable {
    if (!sent && err.find("hanging") != std::string::npos) ::kill(process, SIGINT);
    sent = sent || err.find("hanging") != std::string::npos;
  };
  const auto result = isolated("out", {"-j", "1"}, options);
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_NE(result.out.find("never       –  cancelled\n"), std::string::npos) << result.out;
  EXPECT_EQ(results("out").at("a").at("status"), "ok");
  EXPECT_EQ(processes(), 0U);
}

TEST_F(Isolated, ItsProcessesEndWithIt) {
  sweep("list: {a: {}, b: {second.number: 3}, never: {second.mode: hang}}\nmetrics: {sum: sum}\n");
  ProcessOptions options;
  options.watch = [this, killed = false](pid_t process, const std::string& err) mutable {
    if (killed || err.find("hanging") == std::string::npos) return;
    killed = true;
    EXPECT_GE(processes(), 1U);
    ::kill(process, SIGKILL);
  };
  isolated("out", {"-j", "1"}, options);
  for (int i = 0; i < 200 && processes() > 0; ++i) ::usleep(10'000);
  EXPECT_EQ(processes(), 0U);
  // And the sweep goes on where it was.
  sweep("list: {a: {}, b: {second.number: 3}, c: {second.number: 4}}\nmetrics: {sum: sum}\n");
  const auto result = isolated("out");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("3 variants done (2 before)"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace atrium::test
