#pragma once
#include <fstream>
#include <map>

#include "tests/pipelines/sweep_case.hpp"

namespace atrium::test {

/// A sweep whose variants share a beginning, run in all ways.
class SweepFolderTest : public Sweep {
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
      if (name.starts_with("farm/") || file == "variant.json" || file == "trace.json" || file == "worker.log") continue;
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
    for (const auto& [file, text] : right) {
      const auto same = left.find(file);
      ASSERT_NE(same, left.end()) << file;
      EXPECT_EQ(same->second, text) << file;
    }
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
};

}  // namespace atrium::test
