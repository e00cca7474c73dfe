#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test {

using nlohmann::json;
namespace fs = std::filesystem;

/// A folder with a small pipeline, base.yaml, and the program's sweeps in it.
class Sweep : public testing::Test {
 protected:
  Sweep() {
    write_text(folder / "base.yaml", R"(atrium: 1
summary: Two numbers.
vars: {start: 1 m}
nodes:
  first: {type: trial.step, params: {value: "${start}"}}
  second: {type: trial.step, in: {after: first.value}, params: {value: 2}}
  random: {type: trial.step, in: {after: first.value}, params: {value: 0}}
  write: {type: trial.write, in: {value: first.value}, params: {path: sub/value.txt}}
outputs: {first: first.value, number: second.value, random: random.value, text: second.text}
)");
  }
  ProcessResult atrium(std::vector<std::string> arguments, ProcessOptions options = {}) {
    arguments.insert(arguments.begin(), {ATRIUM_PROGRAM, "sweep"});
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
    return run_process(arguments, options);
  }
  void sweep(const std::string& rest) { write_text(folder / "s.yaml", "atrium: 1\nsweep: base.yaml\n" + rest); }
  json variants(const ProcessResult& result) { return json::parse(result.out).at("variants"); }
  std::set<std::string> ids(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"plan", "s.yaml", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = atrium(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::set<std::string> found;
    for (const auto& variant : variants(result)) found.insert(variant.at("id"));
    return found;
  }
  /// How many nodes were executed by the last run in the folder.
  std::size_t executed() { return json::parse(read_text(folder / "out/manifest.json")).at("nodes").size(); }

  TemporaryFolder folder;
};

}  // namespace atrium::test
