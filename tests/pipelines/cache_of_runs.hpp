#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test {

using nlohmann::json;
namespace fs = std::filesystem;

/// A pipeline whose nodes take long enough to be worth keeping, and the program with a cache of its own.
class CacheOfRuns : public testing::Test {
 protected:
  CacheOfRuns() {
    write_text(folder / "p.yaml", R"(atrium: 1
vars: {number: 1}
nodes:
  first: {type: trial.fault, params: {number: "${number}", points: 50000, work: 0.05 s}}
  second: {type: trial.fault, in: {after: first.cloud}, params: {points: 80000, work: 0.05 s}}
  third: {type: trial.fault, in: {after: second.cloud}, params: {points: 20000, work: 0.05 s}}
  write: {type: trial.write, in: {value: third.sum}, params: {path: sub/value.txt}}
  cloud: {type: io.write_cloud, in: {cloud: third.cloud}, params: {path: cloud.ply}}
outputs: {sum: third.sum, points: second.cloud}
)");
  }
  ProcessResult atrium(std::vector<std::string> arguments, ProcessOptions options = {}) {
    arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
    options.environment.push_back("ATRIUM_CACHE=" + (folder / "cache").string());
    return run_process(arguments, options);
  }
  json manifest(const std::string& run) { return json::parse(read_text(folder / run / "manifest.json")); }
  /// "first:miss second:hit …"
  std::string uses(const std::string& run) {
    std::string text;
    const json all = manifest(run);
    for (const auto& node : all["nodes"]) {
      std::string use = node.contains("cache") ? node["cache"]["result"].get<std::string>() : "off";
      if (use == "hit" && node["cache"].contains("why")) use = "again";
      text += (text.empty() ? "" : " ") + node["node"].get<std::string>() + ":" + use;
    }
    return text;
  }
  /// All that a run shows but times: hashes of outputs, printed numbers, warnings, files with their bytes.
  std::string shown(const std::string& run) {
    std::string text;
    const json all = manifest(run);
    for (const auto& node : all["nodes"]) {
      text += node["node"].get<std::string>() + node["status"].get<std::string>() + node["outputs"].dump();
      if (node.contains("warnings")) text += node["warnings"].dump();
      if (!node.contains("artefacts")) continue;
      for (const auto& file : node["artefacts"])
        text += file.dump() + read_text(folder / run / file["path"].get<std::string>());
    }
    return text + all["outputs"].dump();
  }
  void expect_sound() {
    const auto result = atrium({"cache", "verify"});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  }

  TemporaryFolder folder;
};

}  // namespace atrium::test
