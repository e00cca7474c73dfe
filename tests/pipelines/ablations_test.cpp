// The ablations as sweep files, and the scripts in share/examples that drive a sweep.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"

namespace atrium::test {
namespace {

TEST(Ablations, CanBePlanned) {
  if (!fs::exists(scans)) GTEST_SKIP() << "no scans beside the checkout";
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(source / "pipelines/ablations")) {
    if (entry.path().stem() == "base") continue;
    ++files;
    const auto result = atrium({"sweep", "plan", "pipelines/ablations/" + entry.path().filename().string(), "--json"});
    ASSERT_EQ(result.exit_code, 0) << entry.path() << "\n" << result.err;
    const auto plan = nlohmann::json::parse(result.out);
    EXPECT_GE(plan.at("variants").size(), 36U) << entry.path();
    EXPECT_EQ(plan.at("duplicates"), 0) << entry.path();
  }
  EXPECT_EQ(files, 6U);
}

TEST(Ablations, OfOneRoomGiveTheirMetrics) {
  const TemporaryFolder folder;
  write_text(folder / "s.yaml",
             "atrium: 1\nsweep: " + (source / "pipelines/ablations/base.yaml").string() +
                 "\nset: {paper/objects.type: object.none}\nscenes: {room: {scene.pipeline: " +
                 (source / "pipelines/comparisons/scenes/room.yaml").string() +
                 ", scene.points: 60000}}\ngrid: {paper.th_sep: [10 cm, 50 cm]}\n"
                 "metrics: {completeness: quality.structure.b50mm.completeness, walls: report.structure.walls}\n");
  const auto result =
      atrium({"sweep", "run", (folder / "s.yaml").string(), "--out", (folder / "out").string(), "--quiet", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const auto& row : nlohmann::json::parse(result.out).at("variants")) {
    EXPECT_GT(std::stod(row.at("completeness").get<std::string>()), 0.9);
    const fs::path variant = folder / ("out/variants/" + row.at("id").get<std::string>());
    EXPECT_TRUE(fs::exists(variant / "structure.glb"));
    EXPECT_TRUE(fs::exists(variant / "picture.png"));
    // th_sep is both: what counts as near, and how far vertices move.
    const std::string resolved = read_text(variant / "resolved.yaml");
    const std::string value = row.at("paper.th_sep") == "10 cm" ? "max_separation: 0.1 m" : "max_separation: 0.5 m";
    EXPECT_NE(resolved.find(value), resolved.rfind(value)) << resolved;
  }
}

ProcessResult example(const std::string& script, const fs::path& folder) {
  ProcessOptions options;
  options.folder = folder;
  options.environment.push_back("ATRIUM=" ATRIUM_PROGRAM);
  options.timeout = 240;
  return run_process({(source / "share/examples" / script).string(), "out-" + script}, options);
}

TEST(Examples, InBashAndPythonDriveASweepAndFindItsBestVariant) {
  const TemporaryFolder folder;
  const auto bash = example("sweep.sh", folder.path());
  ASSERT_EQ(bash.exit_code, 0) << bash.err;
  EXPECT_TRUE(bash.out.starts_with("best: 70 planes, completeness 9")) << bash.out;
  EXPECT_NE(bash.err.find("some variants failed:"), std::string::npos) << bash.err;
  EXPECT_NE(bash.err.find("no plane is a wall"), std::string::npos) << bash.err;
  if (run_process({"sh", "-c", "command -v python3"}).exit_code != 0) GTEST_SKIP() << "python3 is not installed";
  const auto python = example("sweep.py", folder.path());
  ASSERT_EQ(python.exit_code, 0) << python.err;
  EXPECT_EQ(python.out, bash.out);
  EXPECT_NE(python.err.find("1 planes: failed"), std::string::npos) << python.err;
}

}  // namespace
}  // namespace atrium::test
