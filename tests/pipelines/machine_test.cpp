// What the program does when the machine refuses something: closed and full streams, ignored signals, threads, files
// that get too large. tests/faults has the rest.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::machine_test {
namespace {

namespace fs = std::filesystem;

class Machine : public testing::Test {
 protected:
  Machine() {
    write_text(folder / "many.yaml", many());
    write_text(folder / "sweep.yaml", "atrium: 1\nsweep: many.yaml\ngrid: {cloud.number: [1, 2, 3]}\n");
  }
  static std::string many() {
    std::string text =
        "atrium: 1\nnodes:\n  cloud: {type: trial.fault, params: {points: 20000}}\n"
        "  slow: {type: trial.fault, in: {after: cloud.cloud}, params: {work: 0.3}}\n";
    for (int i = 0; i < writers; ++i)
      text += "  w" + std::to_string(i) + ": {type: io.write_cloud, in: {cloud: cloud.cloud}, params: {path: w" +
              std::to_string(i) + ".csv}}\n";
    return text + "outputs: {sum: slow.sum}\n";
  }
  /// `atrium WORDS` by bash, with whatever redirections are in the words.
  ProcessResult shell(const std::string& words, const std::string& before = "", ProcessOptions options = {}) {
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
    return run_process({"/bin/bash", "-c", before + "exec '" ATRIUM_PROGRAM "' " + words}, options);
  }
  ProcessResult with_fault(const std::string& words, const std::string& fault) {
    ProcessOptions options;
    options.environment = {"ATRIUM_FAULT=" + fault};
    return shell(words, "export LD_PRELOAD='" ATRIUM_FAULTS "'; ", options);
  }
  /// The hashes of what the writers wrote: the texts are too long for messages of gtest.
  std::map<std::string, std::size_t> written(const std::string& run) const {
    std::map<std::string, std::size_t> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder / run))
      if (entry.path().filename().string().starts_with('w') && entry.path().extension() == ".csv")
        files[fs::relative(entry.path(), folder / run)] = std::hash<std::string>{}(read_text(entry.path()));
    return files;
  }

  static constexpr int writers = 20;
  TemporaryFolder folder;
};

TEST_F(Machine, WhatIsPrintedNeverGoesIntoFilesWhateverStreamIsClosed) {
  ASSERT_EQ(shell("run many.yaml --out expected -q").exit_code, 0);
  const auto expected = written("expected");
  ASSERT_EQ(expected.size(), writers);
  int n = 0;
  for (const char* closed : {"<&-", ">&-", "2>&-", "<&- >&-", "<&- 2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    const std::string use = " --cache cache" + std::to_string(n) + " --out run" + std::to_string(n);
    EXPECT_EQ(shell("run many.yaml" + use + " " + closed).exit_code, 0) << closed;
    EXPECT_EQ(written("run" + std::to_string(n)), expected) << closed;
    const auto later = shell("run many.yaml" + use);
    EXPECT_EQ(later.exit_code, 0) << later.err;
    EXPECT_NE(later.err.find("by the cache"), std::string::npos) << later.err;
    EXPECT_EQ(written("run" + std::to_string(n++)), expected) << closed;
  }
  ASSERT_EQ(shell("sweep run sweep.yaml --out open -q").exit_code, 0);
  EXPECT_EQ(shell("sweep run sweep.yaml --isolate --out closed <&- >&- 2>&-").exit_code, 0);
  EXPECT_EQ(written("closed"), written("open"));
}

TEST_F(Machine, AWorkerThatNobodyListensToKeepsItsEventsOutOfFiles) {
  ASSERT_EQ(shell("sweep run sweep.yaml --out sweep -q").exit_code, 0);
  const auto expected = written("sweep");
  const std::string id = fs::directory_iterator(folder / "sweep/variants")->path().filename();
  shell("sweep work sweep " + id + " --here 3>&-");  // what is said of it does not matter
  EXPECT_EQ(written("sweep"), expected);
}

TEST_F(Machine, ACompleteRunIsCompleteThoughStderrCannotBeWritten) {
  EXPECT_EQ(shell("run many.yaml --out full 2>/dev/full").exit_code, 0);
  EXPECT_EQ(shell("run many.yaml --out gone 2> >(exec true)").exit_code, 0);  // nobody reads the pipe: SIGPIPE
  EXPECT_EQ(shell("sweep run sweep.yaml --out sweep 2>/dev/full").exit_code, 0);
}

TEST_F(Machine, AResultThatCannotBePrintedIsAnError) {
  for (const char* words : {"run many.yaml --out r --json >/dev/full", "run many.yaml --out r --json >&-", "nodes >&-",
                            "run many.yaml --out r >/dev/full", "--help >/dev/full", "schema >/dev/full"}) {
    const auto result = shell(words);
    EXPECT_EQ(result.exit_code, 1) << words;
    EXPECT_NE(result.err.find("atrium: error: cannot write to "), std::string::npos) << words << "\n" << result.err;
  }
}

TEST_F(Machine, AFileThatGetsTooLargeIsAnErrorAndIsNotThere) {
  const auto result = shell("run many.yaml --out r", "ulimit -f 64; ");  // in units of 1024 bytes
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("w7.csv: File too large"), std::string::npos) << result.err;
  EXPECT_TRUE(written("r").empty());
  EXPECT_EQ(shell("run many.yaml --out r -q").exit_code, 0);
  EXPECT_EQ(written("r").size(), writers);
}

TEST_F(Machine, ASignalThatTheParentIgnoresStaysIgnored) {
  for (const int signal : {SIGINT, SIGHUP}) {
    ProcessOptions options;
    bool sent = false;
    options.watch = [&](pid_t process, const std::string& err) {
      if (sent || err.find("cloud: 0.") == std::string::npos) return;
      sent = true;
      ::kill(process, signal);
    };
    const auto result = shell("run many.yaml --out r", "trap '' INT HUP; ", options);
    EXPECT_TRUE(sent);
    EXPECT_EQ(result.exit_code, 0) << signal << "\n" << result.err;
  }
}

TEST_F(Machine, WhereThreadsAreRefusedFewerDoTheSame) {
  ASSERT_EQ(shell("run many.yaml --out expected -q").exit_code, 0);
  const auto expected = written("expected");
  struct Refused {
    std::string fault, says;
  };
  // The first thread is the one that draws progress.
  for (const auto& [fault, says] :
       {Refused{"thread:1:all", "of 8 threads the system gives 1 only (Resource temporarily unavailable)"},
        Refused{"thread:7:all", "of 8 threads the system gives 6 only (Resource temporarily unavailable)"},
        Refused{"thread:2", "of 8 threads the system gives 1 only"}}) {
    const auto result = with_fault("run many.yaml -j 8 --cache cache-" + fault + " --out r", fault);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_EQ(written("r"), expected);
    const auto later = shell("run many.yaml --cache cache-" + fault + " --out r");
    EXPECT_NE(later.err.find("(22 by the cache)"), std::string::npos) << later.err;
    EXPECT_EQ(written("r"), expected);
  }
  const auto manifest = nlohmann::json::parse(read_text(folder / "r/manifest.json"));
  EXPECT_EQ(manifest["status"], "ok");
}

TEST_F(Machine, SweepsGoOnWithFewerThreadsAndProcesses) {
  ASSERT_EQ(shell("sweep run sweep.yaml --out expected -q").exit_code, 0);
  const auto expected = written("expected");
  const auto together = with_fault("sweep run sweep.yaml -j 8 --out together", "thread:3:all");
  EXPECT_EQ(together.exit_code, 0) << together.err;
  EXPECT_NE(together.err.find("of 8 threads the system gives 2 only"), std::string::npos) << together.err;
  EXPECT_EQ(written("together"), expected);
  const auto isolated = with_fault("sweep run sweep.yaml -j 9 --isolate --out isolated", "thread:2:all");
  EXPECT_EQ(isolated.exit_code, 0) << isolated.err;
  EXPECT_NE(isolated.err.find("threads the system gives "), std::string::npos) << isolated.err;
  EXPECT_EQ(written("isolated"), expected);
  const auto fewer = with_fault("sweep run sweep.yaml -j 3 --isolate --out fewer", "fork:3");
  EXPECT_EQ(fewer.exit_code, 0) << fewer.err;
  EXPECT_NE(fewer.err.find("Resource temporarily unavailable: "), std::string::npos) << fewer.err;
  EXPECT_EQ(written("fewer"), expected);
}

TEST_F(Machine, ASmallAddressSpaceEndsInAnErrorOrInTheResult) {
  for (const int mebibytes : {400, 600, 900, 1400}) {
    const auto result = shell("run many.yaml -j 64 --out r", "ulimit -v " + std::to_string(mebibytes * 1024) + "; ");
    EXPECT_TRUE(result.exit_code == 0 || (result.exit_code <= 5 && result.err.find("error") != std::string::npos))
        << mebibytes << ": " << result.exit_code << "\n"
        << result.err;
  }
}

}  // namespace
}  // namespace atrium::test::machine_test
