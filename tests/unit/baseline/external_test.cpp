#include "modules/baseline/external.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "graph/api/helper_memory.hpp"
#include "tests/unit/baseline/meshes.hpp"

namespace atrium::baseline::external_test {
namespace {

namespace fs = std::filesystem;

class Host : public ContextHost {
 public:
  explicit Host(fs::path folder) : folder_(std::move(folder)) {}
  fs::path output_folder() override { return folder_; }
  bool cancelled() override { return cancel && ++asked > 5; }
  bool cancel = false;
  int asked = 0;

 private:
  fs::path folder_;
};

class BaselineExternal : public testing::Test {
 protected:
  BaselineExternal() {
    folder_ = fs::temp_directory_path() / ("atrium_external_test_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    host_ = std::make_shared<Host>(folder_);
    in_.mesh = input(box(Vector3d(1, 2, 3), 2));
  }
  ~BaselineExternal() override { fs::remove_all(folder_); }

  Mesh run(const External::Params& params) {
    Context context(1, host_);
    return External::run(in_, params, context).mesh;
  }
  External::Params command(std::vector<std::string> words) const {
    External::Params params;
    params.command = std::move(words);
    return params;
  }
  // A shell script that the test itself names as the program; $1, $2 … are the other words.
  External::Params script(const std::string& text, std::vector<std::string> words = {"{output}"}) const {
    std::vector<std::string> all{"/bin/sh", "-c", text, "script"};
    all.insert(all.end(), words.begin(), words.end());
    return command(all);
  }
  std::string problem(const External::Params& params) {
    try {
      run(params);
    } catch (const Error& error) {
      return std::string(error.what()) + " / " + error.help();
    }
    return "none";
  }
  std::string log() const {
    std::ifstream file(folder_ / "external.log");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path folder_;
  std::shared_ptr<Host> host_;
  External::In in_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(BaselineExternal, TheMeshComesBackFromEveryFormat) {
  using Format = External::MeshFormat;
  for (const auto format : {Format::ply, Format::obj, Format::stl}) {
    auto params = command({"cp", "{mesh}", "{output}"});
    params.mesh = params.output = format;
    const Mesh mesh = run(params);
    EXPECT_EQ(mesh.triangles.size(), in_.mesh->triangles.size());
    EXPECT_NEAR(volume(mesh), 6, 1e-9);
  }
}

TEST_F(BaselineExternal, TheOriginStaysOutOfTheFilesAndComesBack) {
  Mesh far = *in_.mesh;
  far.origin = {5e5, 5.4e6, 100};
  in_.mesh = input(far);
  const Mesh mesh = run(script("head -c 100000 \"$1\" | grep -a -c 5400000; cp \"$1\" \"$2\"", {"{mesh}", "{output}"}));
  EXPECT_EQ(log(), "0\n");
  Vector3d least = Vector3d::Constant(1e300);
  for (const auto& v : mesh.vertices) least = least.cwiseMin(mesh.origin + v);
  EXPECT_EQ(least, far.origin);
}

TEST_F(BaselineExternal, InputsAreWrittenWhereTheCommandNamesThem) {
  Cloud cloud;
  cloud.points = {{1, 2, 3}, {4, 5, 6}};
  in_.cloud = input(cloud);
  PlanePrimitives planes;
  planes.cloud = input(cloud);
  planes.primitives.resize(1);
  planes.primitives[0].inliers = {0, 1};
  in_.planes = input(planes);
  auto params = script("tail -n 2 \"$1\"; head -n 1 \"$2\"; echo \"$3\"; pwd; cp \"$4\" \"$5\"",
                       {"{cloud}", "{planes}", "--x={folder}/a;b $HOME", "{mesh}", "{output}"});
  params.cloud = External::CloudFormat::xyz;
  run(params);
  EXPECT_TRUE(contains(log(), "1 2 3\n4 5 6\nnum_points: 2\n")) << log();
  EXPECT_TRUE(contains(log(), "/a;b $HOME\n")) << log();  // no shell touched it
  const auto at = log().find("--x=") + 4;
  const std::string folder = log().substr(at, log().find("/a;b") - at);
  EXPECT_TRUE(contains(log(), "\n" + folder + "\n")) << log();  // the working folder
  EXPECT_FALSE(fs::exists(folder));                             // which is gone
}

TEST_F(BaselineExternal, BothStreamsAreKeptInTheLog) {
  run(script("echo out; echo err >&2; cp \"$1\" \"$2\"", {"{mesh}", "{output}"}));
  EXPECT_EQ(log(), "out\nerr\n");
}

TEST_F(BaselineExternal, AFailureIsAnErrorWithTheEndOfTheLog) {
  const std::string text = problem(script("seq 1 10000; echo the reason; exit 3"));
  EXPECT_TRUE(contains(text, "exit code 3")) << text;
  EXPECT_TRUE(contains(text, "the reason")) << text;
  EXPECT_FALSE(contains(text, "\n1\n"));
  EXPECT_TRUE(contains(log(), "1\n2\n"));
  EXPECT_TRUE(contains(problem(script("kill -SEGV $$")), "Segmentation fault"));
}

TEST_F(BaselineExternal, MissingProgramsAndOutputsAreErrors) {
  EXPECT_TRUE(contains(problem(command({"no-such-program", "{output}"})), "there is no program 'no-such-program'"));
  EXPECT_TRUE(contains(problem(command({"/no/such", "{output}"})), "there is no program '/no/such'"));
  EXPECT_TRUE(contains(problem(command({"/tmp", "{output}"})), "there is no program '/tmp'"));
  EXPECT_TRUE(contains(problem(script("true")), "wrote no output"));
  EXPECT_TRUE(contains(problem(script("echo nonsense > \"$1\"")), "cannot be read"));
  EXPECT_TRUE(contains(problem(script(": > \"$1\"")), "cannot be read"));
}

TEST_F(BaselineExternal, WrongCommandsAreErrors) {
  EXPECT_TRUE(contains(problem(command({})), "no command"));
  EXPECT_TRUE(contains(problem(command({"cp", "{mesh}"})), "no {output}"));
  EXPECT_TRUE(contains(problem(command({"cp", "{mash}", "{output}"})), "{mash}"));
  EXPECT_TRUE(contains(problem(command({"cp", "{cloud}", "{output}"})), "not wired"));
  Cloud cloud;
  cloud.origin = {1, 0, 0};
  in_.cloud = input(cloud);
  EXPECT_TRUE(contains(problem(command({"cp", "{mesh}", "{output}"})), "different origins"));
}

// What the script started ends too: its process number stands in the log.
TEST_F(BaselineExternal, TheTimeLimitEndsTheWholeGroup) {
  auto params = script("sleep 1000 & echo $!; wait");
  params.time_limit = 0.3;
  EXPECT_TRUE(contains(problem(params), "time limit of 0.3 s"));
  const int child = std::stoi(log());
  ASSERT_GT(child, 1);
  const auto alive = [&] {
    std::ifstream state("/proc/" + std::to_string(child) + "/stat");
    std::string number, name, letter;
    state >> number >> name >> letter;
    return state && letter != "Z" && name == "(sleep)";
  };
  for (int i = 0; alive() && i < 1000; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(alive());
}

// A daemon has left the group and the session, and its parent has ended.
TEST_F(BaselineExternal, DaemonsEndToo) {
  const std::string daemon = "setsid sh -c 'sleep 1000 & echo $!' & wait; ";
  const auto gone = [&] {
    const int child = std::stoi(log());
    std::ifstream state("/proc/" + std::to_string(child) + "/stat");
    std::string number, name, letter;
    state >> number >> name >> letter;
    return child > 1 && (!state || letter == "Z" || name != "(sleep)");
  };
  run(script(daemon + "cp \"$1\" \"$2\"", {"{mesh}", "{output}"}));
  EXPECT_TRUE(gone());
  auto late = script(daemon + "sleep 1000");
  late.time_limit = 0.5;
  EXPECT_TRUE(contains(problem(late), "time limit"));
  EXPECT_TRUE(gone());
}

TEST_F(BaselineExternal, DoubledBracesArePlain) {
  run(script("echo \"$1\"; cp \"$2\" \"$3\"", {"{{mesh}} {{{{ }} {}", "{mesh}", "{output}"}));
  EXPECT_EQ(log(), "{mesh} {{ } {}\n");
  EXPECT_TRUE(contains(problem(command({"cp", "{mesh}", "{{output}}"})), "no {output}"));
}

TEST_F(BaselineExternal, WhatAProgramPutsInTheWayOfTheLogDoesNotBlock) {
  run(script("rm -f log; mkfifo log; echo said; cp \"$1\" \"$2\"", {"{mesh}", "{output}"}));
  EXPECT_EQ(log(), "said\n");
  auto params = script("cp \"$1\" \"$2\"", {"{mesh}", "{output}"});
  params.log.path = "pipe";
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(contains(problem(params), "is no file"));
  EXPECT_TRUE(contains(problem(script("mkfifo \"$1\"")), "wrote no output"));
}

TEST_F(BaselineExternal, ALongLogKeepsItsBeginningAndItsEnd) {
  run(script("echo first; head -c 40000000 /dev/zero | tr '\\0' x; echo; echo last; cp \"$1\" \"$2\"",
             {"{mesh}", "{output}"}));
  const std::string text = log();
  EXPECT_TRUE(text.starts_with("first\nxxx"));
  EXPECT_TRUE(text.ends_with("xxx\nlast\n"));
  EXPECT_TRUE(contains(text, "bytes are left out here]"));
  EXPECT_LT(text.size(), 2 * (8U << 20U) + 100);
  EXPECT_GT(text.size(), 2 * (8U << 20U) - 100);
}

TEST_F(BaselineExternal, WhoIgnoresTheFirstSignalIsKilled) {
  auto params = script("trap '' TERM; while :; do sleep 0.1; done");
  params.time_limit = 0.2;
  EXPECT_TRUE(contains(problem(params), "time limit"));
}

TEST_F(BaselineExternal, CancellingTheRunEndsIt) {
  host_->cancel = true;
  EXPECT_THROW(run(script("sleep 1000")), Cancelled);
}

// What a program needs is counted, and not what this one needed when it was started.
TEST_F(BaselineExternal, TheProgramsMemoryIsNoted) {
  const std::vector<char> large(300U << 20U, 1);
  take_helper_memory();
  run(script("sleep 0.2; cp \"$1\" \"$2\"", {"{mesh}", "{output}"}));
  const auto small = take_helper_memory();
  EXPECT_GT(small, 100U << 10U);
  EXPECT_LT(small, 50U << 20U);
  run(script("head -c 60M /dev/zero | (sleep 0.3; tail -c 55M | (sleep 0.3; wc -c)); cp \"$1\" \"$2\"",
             {"{mesh}", "{output}"}));
  EXPECT_GT(take_helper_memory(), 50U << 20U);
  EXPECT_EQ(large[5], 1);
}

TEST_F(BaselineExternal, TheMemoryLimitHolds) {
  auto params = script("head -c 400M /dev/zero | tail -c 300M | wc -c; exit 5");
  params.memory_limit = 100;
  EXPECT_TRUE(contains(problem(params), "exhausted") || contains(problem(params), "allocate"));
}

}  // namespace
}  // namespace atrium::baseline::external_test
