// `atrium sweep run --isolate`: what happens to a process costs its variant only, and changes nothing else.
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <csignal>

#include "tests/pipelines/sweep_folder_test.hpp"

namespace atrium::test::isolate_test {
namespace {

class Isolated : public SweepFolderTest {
 protected:
  ProcessResult isolated(const std::string& out, std::vector<std::string> more = {}, ProcessOptions options = {}) {
    more.insert(more.begin(), {"run", "s.yaml", "--isolate", "--out", out, "--cache", "cache-" + out});
    return atrium(std::move(more), std::move(options));
  }
};

TEST_F(Isolated, LeavesTheSameBytes) {
  sweep(
      "grid: {second.number: [2, 3, 4]}\nseeds: [1, 2]\n"
      "metrics: {sum: sum, random: random, text: text}\npictures: {sheet.png: look.png}\n");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "together", "--no-cache", "-q"}).exit_code, 0);
  const auto expected = left("together");
  EXPECT_GT(expected.size(), 6U * 5U);
  for (const auto& [out, more] : std::map<std::string, std::vector<std::string>>{
           {"one", {"-j", "1"}}, {"three", {"-j", "3"}}, {"none", {"--no-cache"}}}) {
    auto arguments = more;
    arguments.insert(arguments.begin(), {"run", "s.yaml"});
    arguments.insert(arguments.end(), {"--isolate", "--out", out, "-q", "--cache", "cache-" + out});
    const auto result = atrium(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    expect_same(left(out), expected);
    EXPECT_FALSE(fs::exists(folder / out / "farm"));
  }
  // What one way of running has done, the other takes as done, and nothing is left to do; nor if the cache has all.
  EXPECT_NE(isolated("together").err.find("(6 before)"), std::string::npos);
  EXPECT_NE(atrium({"run", "s.yaml", "--out", "one"}).err.find("(6 before)"), std::string::npos);
  const auto known = atrium({"run", "s.yaml", "--isolate", "--out", "known", "--cache", "cache-three"});
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
                                         Crash{"hang", {"--timeout", "4"}, "ended after 4 s (--timeout)"}),
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
  for (const auto& node : manifest.at("nodes")) {
    if (node.at("status") != "ok") continue;
    EXPECT_EQ(node.at("cache").at("result"), "miss") << node;
  }
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

// A shell may start something, and then become the program: its children stay the program's.
TEST_F(Isolated, ProcessesThatAreNotItsOwnLiveOn) {
  sweep("list: {a: {}, bad: {second.mode: segv}, b: {second.number: 3}}\nmetrics: {sum: sum}\n");
  ProcessOptions options;
  options.folder = folder.path();
  options.environment = {"ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN, "ATRIUM=" ATRIUM_PROGRAM};
  const auto result = run_process({"/bin/sh", "-c",
                                   "sleep 60 >/dev/null 2>&1 & echo $! >stranger; exec \"$ATRIUM\" sweep run s.yaml "
                                   "--isolate --out out --no-cache -q"},
                                  options);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  const pid_t stranger = std::stoi(read_text(folder / "stranger"));
  EXPECT_EQ(::kill(stranger, 0), 0);
  ::kill(stranger, SIGKILL);
}

TEST_F(Isolated, EndsAlsoWhereTheEndOfChildrenIsIgnored) {
  sweep("list: {a: {}, b: {second.number: 3}}\nmetrics: {sum: sum}\n");
  ProcessOptions options;
  options.folder = folder.path();
  options.environment = {"ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN, "ATRIUM=" ATRIUM_PROGRAM};
  const auto result = run_process(
      {"/bin/sh", "-c", "trap '' CHLD; exec \"$ATRIUM\" sweep run s.yaml --isolate --out out --no-cache -q"}, options);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Isolated, AFullDiskIsSaidAndLeavesAFolderThatGoesOn) {
  sweep("grid: {second.number: [2, 3, 4]}\nmetrics: {sum: sum}\n");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "undisturbed"}).exit_code, 0);
  fs::create_directories(folder / "small");
  if (::mount("none", (folder / "small").c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "a small file system can be mounted by root only";
  for (const char* out : {"small/together", "small/isolated"}) {
    std::vector<std::string> run{"run", "s.yaml", "--out", out};
    if (out == std::string("small/isolated")) run.insert(run.end(), {"--isolate", "--cache", "cache"});
    ::mount("none", (folder / "small").c_str(), "tmpfs", MS_REMOUNT, "size=64k");
    const auto full = atrium(run);
    EXPECT_TRUE(full.exit_code == 1 || full.exit_code == 4) << full.exit_code;
    EXPECT_NE((full.out + full.err).find("No space left on device"), std::string::npos) << full.out << full.err;
    ::mount("none", (folder / "small").c_str(), "tmpfs", MS_REMOUNT, "size=50M");
    EXPECT_EQ(atrium(run).exit_code, 0);
    auto found = left(out);
    auto expected = left("undisturbed");
    for (auto* files : {&found, &expected}) files->erase("manifest.json");  // of what was left to do
    expect_same(found, expected);
    fs::remove_all(folder / out);
  }
  ::umount((folder / "small").c_str());
}

}  // namespace
}  // namespace atrium::test::isolate_test
