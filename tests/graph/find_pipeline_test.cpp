// Where a pipeline lies that is named, and what is said when it is nowhere.
#include "graph/pipeline/find_pipeline.hpp"

#include <algorithm>

#include "tests/graph/pipeline_file.hpp"

namespace atrium::find_pipeline_test {
namespace {

namespace fs = std::filesystem;
const fs::path installed = fs::canonical(fs::path(ATRIUM_SOURCE_DIR) / "pipelines");

class FindPipeline : public test::PipelineFile {
 protected:
  NamedPipeline find(const std::string& text) { return find_pipeline(folder.path(), text); }
  void expect_here(const std::string& text) {
    const NamedPipeline found = find(text);
    EXPECT_EQ(found.path, (folder.path() / text).lexically_normal());
    EXPECT_FALSE(found.is_installed) << text;
  }
  void expect_installed(const std::string& text, const std::string& name) {
    const NamedPipeline found = find(text);
    EXPECT_EQ(found.path, installed / name);
    EXPECT_TRUE(found.is_installed) << text;
  }
};

TEST_F(FindPipeline, ABuildTreeHasTheCheckoutsPipelines) {
  EXPECT_EQ(installed_pipelines(), installed);
  const auto& names = installed_pipeline_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const char* name : {"atrium.yaml", "paper.yaml", "ablations/steps.yaml"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST_F(FindPipeline, AnInstalledOneIsFoundByItsName) {
  expect_installed("atrium.yaml", "atrium.yaml");
  expect_installed("ablations/steps.yaml", "ablations/steps.yaml");
  expect_installed("ablations/../paper.yaml", "paper.yaml");
}

TEST_F(FindPipeline, AFileOfThatNameWins) {
  folder.write("atrium.yaml", "no pipeline at all");
  folder.write("ablations/steps.yaml", "");
  expect_here("atrium.yaml");
  expect_here("ablations/steps.yaml");
  expect_installed("paper.yaml", "paper.yaml");
}

// Another pipeline than the one that is meant would be a wrong result.
TEST_F(FindPipeline, WhatIsThereInAnyFormWins) {
  fs::create_directory(folder.path() / "atrium.yaml");
  fs::create_symlink("nowhere", folder.path() / "paper.yaml");
  expect_here("atrium.yaml");
  expect_here("paper.yaml");
}

TEST_F(FindPipeline, APathThatSaysItsFolderMeansThatFolder) {
  for (const std::string text :
       {"./atrium.yaml", "../pipelines/atrium.yaml", "a/../../atrium.yaml", "", ".", "ablations"})
    expect_here(text);
  const NamedPipeline absolute = find("/nowhere/atrium.yaml");
  EXPECT_EQ(absolute.path, "/nowhere/atrium.yaml");
  EXPECT_FALSE(absolute.is_installed);
}

TEST_F(FindPipeline, TheHelpNamesBothPlaces) {
  Findings findings;
  const std::string here = folder.path().string();
  EXPECT_EQ(help_for_missing_pipeline(folder.path(), "artium.yaml", findings),
            "did you mean 'atrium.yaml'? (looked for " + here + "/artium.yaml and for " + installed.string() +
                "/artium.yaml)");
  EXPECT_EQ(help_for_missing_pipeline(folder.path(), "pipelines/atrium.yaml", findings),
            "did you mean 'atrium.yaml'? (looked for " + here + "/pipelines/atrium.yaml and for " + installed.string() +
                "/pipelines/atrium.yaml)");
  EXPECT_EQ(help_for_missing_pipeline(folder.path(), "./atrium.yaml", findings), "looked for " + here + "/atrium.yaml");
}

TEST_F(FindPipeline, ASubPipelineIsLookedForBesideItsFileThenAmongTheInstalledOnes) {
  const std::string use = "atrium: 1\nnodes:\n  sub: {pipeline: simulate.yaml}\n";
  const LoadResult named = load_text(use + "outputs: {cloud: sub.cloud}\n");
  // Its node types are unknown here; what is said of them names the real file.
  ASSERT_FALSE(named.errors.empty());
  EXPECT_EQ(named.errors.front().file, (installed / "simulate.yaml").string());
  folder.write("simulate.yaml", "atrium: 1\nnodes: {made: {type: test.make}}\noutputs: {cloud: made.cloud}\n");
  const LoadResult local = load_text(use + "outputs: {cloud: sub.cloud}\n");
  EXPECT_TRUE(local.errors.empty()) << messages(local);
}

TEST_F(FindPipeline, ASettingsPipelineIsLookedForInTheWorkingFolderThenAmongTheInstalledOnes) {
  const auto file = folder.write("p.yaml", "atrium: 1\nnodes: {a: {type: test.make}}\noutputs: {cloud: a.cloud}\n");
  const LoadResult named = load_pipeline(file, {{"a.pipeline=simulate.yaml", "", folder.path()}}, registry);
  ASSERT_FALSE(named.errors.empty());
  EXPECT_EQ(named.errors.front().file, (installed / "simulate.yaml").string());
  folder.write("work/simulate.yaml", "atrium: 1\nnodes: {made: {type: test.make}}\noutputs: {cloud: made.cloud}\n");
  const fs::path work = folder.path() / "work";
  const LoadResult local = load_pipeline(file, {{"a.pipeline=simulate.yaml", "", work}}, registry);
  EXPECT_TRUE(local.errors.empty()) << messages(local);
  const LoadResult nowhere = load_pipeline(file, {{"a.pipeline=gone.yaml", "", work}}, registry);
  ASSERT_EQ(nowhere.errors.size(), 1U) << messages(nowhere);
  EXPECT_EQ(nowhere.errors.front().message, "no such pipeline file: " + (work / "gone.yaml").string());
  EXPECT_NE(nowhere.errors.front().help.find((installed / "gone.yaml").string()), std::string::npos);
  EXPECT_EQ(nowhere.errors.front().notes, std::vector<std::string>{"set by -s a.pipeline=gone.yaml"});
}

}  // namespace
}  // namespace atrium::find_pipeline_test
