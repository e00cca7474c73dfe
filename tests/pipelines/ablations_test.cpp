// The ablations as sweep files, and the scripts in share/examples that drive a sweep.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"
#include "tests/support/lacking.hpp"

namespace atrium::test::ablations_test {
namespace {

TEST(Ablations, CanBePlanned) {
  // The scans that they name are not read for a plan: stand-ins do, beside a copy of the checkout's pipelines.
  const TemporaryFolder folder;
  fs::create_directories(folder / "checkout");
  fs::copy(source / "pipelines", folder / "checkout/pipelines", fs::copy_options::recursive);
  for (const auto& scene : fs::directory_iterator(source / "pipelines/comparisons/scenes")) {
    const fs::path scan = folder / "shared/scans" / scene.path().stem();
    fs::create_directories(scan);
    for (const char* name : {"mesh.ply", "layout.json"}) write_text(scan / name, "");
  }
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder / "checkout/pipelines/ablations")) {
    if (entry.path().stem() == "base") continue;
    ++files;
    const auto result = atrium({"sweep", "plan", entry.path().string(), "--json"});
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
    EXPECT_GT(row.at("completeness").get<double>(), 0.9);
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

TEST(Examples, PairsDifferInNothingButTheColumn) {
  if (!has_program("python3")) ATRIUM_SKIP_LACKING("python3 is not installed");
  // error = 10 × noise + seed, and with method b `noise` more.
  const TemporaryFolder folder;
  const auto axis = [](const std::string& name, const std::vector<std::string>& labels) {
    nlohmann::json json{{"name", name}, {"choices", nlohmann::json::array()}};
    for (const auto& label : labels) json["choices"].push_back({{"label", label}, {"set", {{name, label}}}});
    return json;
  };
  const nlohmann::json axes{axis("noise", {"1", "2"}), axis("method", {"a", "b"}), axis("seed", {"1", "3"})};
  write_text(folder / "sweep.json", nlohmann::json{{"axes", axes}}.dump());
  std::string table = "id,noise,method,seed,error [mm],remark,other,status\n";
  for (int noise = 1; noise <= 2; ++noise)
    for (const std::string method : {"a", "b"})
      for (int seed = 1; seed <= 3; seed += 2) {
        const int error = 10 * noise + seed + (method == "b" ? noise : 0);
        table += "x," + std::to_string(noise) + "," + method + "," + std::to_string(seed) + "," +
                 std::to_string(error) + ",good,,ok\n";
      }
  write_text(folder / "table.csv", table + "x,1,b,5,,,,failed: no\n");
  const auto paired = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> command{(source / "share/examples/paired.py").string(), folder.path().string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_process(command);
  };
  const auto result = paired({"method", "a"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "| noise | method | error [mm] |\n"
            "| --- | --- | --: |\n"
            "| 1 | b | +1.00 ± 0.00 |\n"
            "| 2 | b | +2.00 ± 0.00 |\n");
  EXPECT_NE(paired({"method", "c"}).err.find("no variant has method = c"), std::string::npos);
  EXPECT_NE(paired({"mthod", "a"}).err.find("does not vary 'mthod'"), std::string::npos);
  EXPECT_NE(paired({"method", "a", "remark"}).err.find("no metric 'remark' that is a number"), std::string::npos);
}

TEST(Examples, InBashAndPythonDriveASweepAndFindItsBestVariant) {
  const TemporaryFolder folder;
  const auto bash = example("sweep.sh", folder.path());
  ASSERT_EQ(bash.exit_code, 0) << bash.err;
  EXPECT_TRUE(bash.out.starts_with("best: 70 planes, completeness 9")) << bash.out;
  EXPECT_NE(bash.err.find("some variants failed:"), std::string::npos) << bash.err;
  EXPECT_NE(bash.err.find("no plane is a wall"), std::string::npos) << bash.err;
  if (!has_program("python3")) ATRIUM_SKIP_LACKING("python3 is not installed");
  const auto python = example("sweep.py", folder.path());
  ASSERT_EQ(python.exit_code, 0) << python.err;
  EXPECT_EQ(python.out, bash.out);
  EXPECT_NE(python.err.find("1 planes: failed"), std::string::npos) << python.err;
}

}  // namespace
}  // namespace atrium::test::ablations_test
