// `atrium run` as its users see it: exit codes, stdout, stderr, signals, files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::run_test {
namespace {

using nlohmann::json;

class RunProgram : public testing::Test {
 protected:
  ProcessResult atrium(std::vector<std::string> arguments, ProcessOptions options = {}) {
    arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
    options.environment.push_back("TERM=xterm");
    return run_process(arguments, options);
  }
  json manifest(const std::string& run) { return json::parse(read_text(folder / run / "manifest.json")); }
  std::string status(const std::string& run, const std::string& node) {
    const auto all = manifest(run);
    for (const auto& n : all["nodes"])
      if (n["node"] == node) return n["status"];
    return "not there";
  }
  // Signals the process once it has said `text`.
  static ProcessOptions signal_at(const std::string& text, int signal) {
    ProcessOptions options;
    options.watch = [text, signal, sent = false](pid_t process, const std::string& err) mutable {
      if (sent || err.find(text) == std::string::npos) return;
      sent = true;
      ::kill(process, signal);
    };
    return options;
  }
  void pipeline(const std::string& second) {
    write_text(folder / "p.yaml", R"(atrium: 1
seed: 5
nodes:
  first: {type: trial.step, params: {value: 0}}
  second: {type: trial.step, in: {after: first.value}, params: {mode: )" +
                                      second + R"(}}
  third: {type: trial.step, in: {after: second.value}}
  write: {type: trial.write, in: {value: first.value}, params: {path: sub/value.txt}}
outputs: {number: first.value, text: third.text}
)");
  }

  TemporaryFolder folder;
};

TEST_F(RunProgram, ResultsGoToStdoutEverythingElseToStderr) {
  pipeline("pass");
  const auto result = atrium({"run", "p.yaml", "--out", "r", "-s", "first.value=2 m"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "number                    2\ntext    the sum is 5.000000\n");
  EXPECT_NE(result.err.find("warning: write: only one number\n"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("4 nodes done in "), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
  EXPECT_EQ(read_text(folder / "r/sub/value.txt"), "2.000000\n");
  EXPECT_EQ(manifest("r")["status"], "ok");
}

TEST_F(RunProgram, WhatLibrariesPrintGoesToStderr) {
  pipeline("print");
  const auto result = atrium({"run", "p.yaml", "--out", "r", "-s", "first.value=2 m"});
  EXPECT_EQ(result.out, "number                    2\ntext    the sum is 5.000000\n");
  EXPECT_NE(result.err.find("a remark of a library\n"), std::string::npos) << result.err;
}

TEST_F(RunProgram, JsonIsForScripts) {
  pipeline("pass");
  const auto result = atrium({"run", "p.yaml", "--out", "r", "-s", "first.value=2", "--json", "--quiet"});
  EXPECT_EQ(result.err, "");
  const auto out = json::parse(result.out);
  EXPECT_EQ(out["status"], "ok");
  EXPECT_EQ(out["outputs"]["number"]["value"], 2);
  EXPECT_EQ(out["outputs"]["text"]["value"], "the sum is 5.000000");
  EXPECT_EQ(out["folder"], std::filesystem::canonical(folder / "r").string());
}

TEST_F(RunProgram, AFailedNodeIsExitCode1AndTheRestIsDone) {
  pipeline("fail");
  const auto result = atrium({"run", "p.yaml", "--out", "r", "--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "error: second (trial.step): told to fail\n  help: do not tell it\n");
  EXPECT_EQ(result.out.substr(0, 8), "number  ");
  EXPECT_EQ(result.out.find("text"), std::string::npos);
  EXPECT_EQ(status("r", "third"), "skipped");
  EXPECT_EQ(status("r", "write"), "ok");
}

TEST_F(RunProgram, MistakesOfUsageAre2AndOfTheFile3) {
  pipeline("pass");
  EXPECT_EQ(atrium({"run"}).exit_code, 2);
  EXPECT_EQ(atrium({"run", "p.yaml", "-j", "0"}).exit_code, 2);
  EXPECT_EQ(atrium({"run", "p.yaml", "--no-such-option"}).exit_code, 2);
  const auto foreign = atrium({"run", "p.yaml", "--out", "."});
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_NE(foreign.err.find("is not the folder of a run"), std::string::npos) << foreign.err;
  EXPECT_EQ(atrium({"run", "no.yaml", "--out", "r"}).exit_code, 3);
  EXPECT_EQ(atrium({"run", "p.yaml", "--out", "r", "-s", "second.mode=hop"}).exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "r"));
}

TEST_F(RunProgram, WithoutOutTheFolderIsNamedAfterFileAndTime) {
  pipeline("pass");
  EXPECT_EQ(atrium({"run", "p.yaml"}).exit_code, 0);
  EXPECT_EQ(atrium({"run", "p.yaml"}).exit_code, 0);
  int runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "runs")) {
    ++runs;
    EXPECT_EQ(entry.path().filename().string().substr(0, 4), "p-20");
    EXPECT_TRUE(std::filesystem::exists(entry.path() / "manifest.json"));
  }
  EXPECT_EQ(runs, 2);
}

TEST_F(RunProgram, ASignalEndsTheRunAndKeepsWhatIsDone) {
  pipeline("wait");
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const auto result = atrium({"run", "p.yaml", "--out", "r", "-j", "1"}, signal_at("second: waiting", signal));
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_EQ(result.out.substr(0, 8), "number  ");
    EXPECT_EQ(manifest("r")["status"], "cancelled");
    EXPECT_EQ(status("r", "first"), "ok");
    EXPECT_EQ(status("r", "second"), "cancelled");
    EXPECT_EQ(status("r", "third"), "cancelled");
  }
}

TEST_F(RunProgram, ASecondSignalEndsItAtOnce) {
  pipeline("ignore");
  ProcessOptions options;
  int sent = 0;
  options.watch = [&](pid_t process, const std::string& err) {
    const auto* expected = sent == 0 ? "second: waiting" : "once more: end at once";
    if (sent > 1 || err.find(expected) == std::string::npos) return;
    ++sent;
    ::kill(process, SIGINT);
  };
  const auto result = atrium({"run", "p.yaml", "--out", "r"}, options);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(manifest("r")["status"], "running");
}

TEST_F(RunProgram, ATerminalHasOneLiveLineAndColoursUnlessToldNot) {
  if (::posix_openpt(O_RDWR | O_NOCTTY) < 0) GTEST_SKIP() << "skipped: this machine has no pseudo-terminals";
  pipeline("wait");
  auto options = signal_at("[", SIGINT);
  options.watch = [sent = false](pid_t process, const std::string& err) mutable {
    if (sent || err.find("] second  0:0") == std::string::npos) return;
    sent = true;
    ::kill(process, SIGINT);
  };
  options.terminal = true;
  const auto result = atrium({"run", "p.yaml", "--out", "r", "-j", "1", "-s", "write.path=x.txt"}, options);
  EXPECT_EQ(result.exit_code, 130) << result.err;
  pipeline("fail");
  options.watch = nullptr;
  EXPECT_NE(atrium({"run", "p.yaml", "--out", "r"}, options).err.find("\x1b[31merror:\x1b[0m second"),
            std::string::npos);
  options.environment = {"NO_COLOR=1"};
  EXPECT_EQ(atrium({"run", "p.yaml", "--out", "r"}, options).err.find("\x1b[31m"), std::string::npos);
}

TEST_F(RunProgram, RunningTheResolvedFileGivesTheSameBytes) {
  pipeline("pass");
  ASSERT_EQ(atrium({"run", "p.yaml", "--out", "a", "-j", "1", "-s", "second.value=7"}).exit_code, 0);
  ASSERT_EQ(atrium({"run", "a/resolved.yaml", "--out", "b", "-j", "4"}).exit_code, 0);
  EXPECT_EQ(read_text(folder / "a/resolved.yaml"), read_text(folder / "b/resolved.yaml"));
  EXPECT_EQ(read_text(folder / "a/sub/value.txt"), read_text(folder / "b/sub/value.txt"));
  const auto a = manifest("a");
  const auto b = manifest("b");
  EXPECT_EQ(a["outputs"], b["outputs"]);
  for (std::size_t i = 0; i < a["nodes"].size(); ++i) EXPECT_EQ(a["nodes"][i]["outputs"], b["nodes"][i]["outputs"]);
  // And into its own folder: the file is read before the folder's files are replaced.
  ASSERT_EQ(atrium({"run", "a/resolved.yaml", "--out", "a"}).exit_code, 0);
  EXPECT_EQ(manifest("a")["outputs"], b["outputs"]);
}

}  // namespace
}  // namespace atrium::test::run_test
