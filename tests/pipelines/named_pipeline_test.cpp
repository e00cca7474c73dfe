// The installed pipelines by their names, from any folder; a build tree's are the checkout's.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::named_pipeline_test {
namespace {

using nlohmann::json;

class NamedPipeline : public testing::Test {
 protected:
  ProcessResult atrium(std::vector<std::string> words) {
    words.insert(words.begin(), ATRIUM_PROGRAM);
    ProcessOptions options;
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_CACHE=" + (folder / "cache").string());
    return run_process(words, options);
  }
  ProcessResult simulate(const std::string& file, const std::string& out) {
    return atrium({"run", file, "-s", "scene.type=synth.room", "-s", "points=2000", "--out", out});
  }
  json manifest(const std::string& run) { return json::parse(read_text(folder / run / "manifest.json")); }

  TemporaryFolder folder;
};

TEST_F(NamedPipeline, RunsFromAnyFolderAsByItsPath) {
  const std::string path = (source / "pipelines/simulate.yaml").string();
  const auto by_name = simulate("simulate.yaml", "name");
  ASSERT_EQ(by_name.exit_code, 0) << by_name.err;
  const auto by_path = simulate(path, "path");
  ASSERT_EQ(by_path.exit_code, 0) << by_path.err;
  EXPECT_EQ(by_name.out, by_path.out);
  EXPECT_EQ(manifest("name").at("pipeline"), fs::canonical(path).string());
  EXPECT_EQ(read_text(folder / "name/resolved.yaml"), read_text(folder / "path/resolved.yaml"));
  EXPECT_EQ(read_text(folder / "name/scan.ply"), read_text(folder / "path/scan.ply"));
  // What is computed depends on the pipeline's contents, not on how it was found.
  for (const auto& node : manifest("path").at("nodes"))
    EXPECT_EQ(node.at("cache").at("result"), "hit") << node.at("node");
}

TEST_F(NamedPipeline, PathsOfSettingsAreMeantFromTheWorkingFolder) {
  write_text(folder / "few.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  const auto found = atrium({"check", "atrium.yaml", "-s", "scan=few.xyz"});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  const auto missing = atrium({"check", "atrium.yaml", "-s", "scan=none.xyz"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.err.find("no such file: " + (folder / "none.xyz").string()), std::string::npos) << missing.err;
  EXPECT_EQ(missing.err.find(fs::canonical(source / "pipelines/atrium.yaml").string() + ":"), 0U) << missing.err;
}

TEST_F(NamedPipeline, ALocalFileOfThatNameWins) {
  write_text(folder / "simulate.yaml",
             "atrium: 1\nnodes: {scene: {type: synth.room}}\noutputs: {scene: scene.scene}\n");
  const auto result = atrium({"check", "simulate.yaml"});
  EXPECT_EQ(result.out, "ok: 1 node\n") << result.err;
  const auto sub = atrium({"check", "textured.yaml", "-s", "scan=simulate.yaml", "-s", "model.pipeline=simulate.yaml"});
  EXPECT_EQ(sub.exit_code, 3);
  EXPECT_NE(sub.err.find((folder / "simulate.yaml").string()), std::string::npos) << sub.err;
}

TEST_F(NamedPipeline, ASubPipelineIsNamedInASetting) {
  write_text(folder / "few.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  const auto result = atrium({"check", "stages.yaml", "-s", "scan=few.xyz", "-s", "model.pipeline=atrium.yaml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(NamedPipeline, OneThatIsNowhereIsSaidWithBothPlaces) {
  const auto result = atrium({"run", "artium.yaml", "--out", "r"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err, "artium.yaml: error: no such pipeline file\n  help: did you mean 'atrium.yaml'? (looked for " +
                            (folder / "artium.yaml").string() + " and for " +
                            (fs::canonical(source / "pipelines") / "artium.yaml").string() + ")\n");
  EXPECT_FALSE(fs::exists(folder / "r"));
}

TEST_F(NamedPipeline, ASweepsBaseAndTheSweepItself) {
  write_text(folder / "s.yaml",
             "atrium: 1\nsweep: simulate.yaml\nset: {scene.type: synth.room}\ngrid: {points: [1000, 2000]}\n");
  const auto run = atrium({"sweep", "run", "s.yaml", "--out", "out", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json record = json::parse(read_text(folder / "out/sweep.json"));
  EXPECT_EQ(record.at("base"), fs::canonical(source / "pipelines/simulate.yaml").string());
  const auto plan = atrium({"sweep", "plan", "ablations/steps.yaml", "--json"});
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  const auto by_path = atrium({"sweep", "plan", (source / "pipelines/ablations/steps.yaml").string(), "--json"});
  EXPECT_EQ(plan.out, by_path.out);
  const auto script = atrium({"sweep", "submit", "s.yaml", "--engine", "slurm", "--dry-run", "--out", "farm"});
  EXPECT_EQ(script.exit_code, 0) << script.err;
  const auto nowhere = atrium({"sweep", "plan", "step.yaml"});
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_EQ(nowhere.err.find("step.yaml: error: no such pipeline file\n"), 0U) << nowhere.err;
}

}  // namespace
}  // namespace atrium::test::named_pipeline_test
