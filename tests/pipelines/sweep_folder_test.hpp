#pragma once
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test {

using nlohmann::json;
namespace fs = std::filesystem;

/// A sweep whose variants share a beginning, run in all ways.
class SweepFolderTest : public testing::Test {
 protected:
  SweepFolderTest() {
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
    arguments.insert(arguments.begin(), {ATRIUM_PROGRAM, "sweep"});
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
    return run_process(arguments, options);
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
      if (name.starts_with("work/") || file == "variant.json" || file == "trace.json" || file == "worker.log") continue;
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

}  // namespace atrium::test
