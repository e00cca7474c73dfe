// The comparisons with other methods: every file is one that runs, and the table is complete.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::comparisons_test {
namespace {

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(source / "pipelines/comparisons" / folder))
    if (entry.path().extension() == ".yaml") names.push_back((folder / entry.path().filename()).string());
  std::sort(names.begin(), names.end());
  return names;
}

void expect_fit(const std::string& base, const fs::path& methods) {
  for (const auto& scene : files_in("scenes")) {
    if (scene.find("quest") != std::string::npos && !fs::exists(scans)) continue;
    for (const auto& method : files_in(methods)) {
      if (method == "methods/points.yaml") continue;  // a part of methods
      const auto result =
          atrium({"check", "pipelines/comparisons/" + base, "-s", "scene.pipeline=pipelines/comparisons/" + scene, "-s",
                  "method.pipeline=pipelines/comparisons/" + method});
      EXPECT_EQ(result.exit_code, 0) << scene << " " << method << "\n" << result.err;
    }
  }
}

TEST(Comparisons, EveryMethodFitsEveryScene) {
  expect_fit("base.yaml", "methods");
  expect_fit("base_plan.yaml", "plans");
  expect_fit("base_building.yaml", "buildings");
}

TEST(Comparisons, EveryTableCanBePlanned) {
  for (const auto& table : files_in("")) {
    if (table.starts_with("base")) continue;
    const bool real = table.find("headset") != std::string::npos || table.find("real") != std::string::npos;
    if (real && !fs::exists(scans)) continue;
    const auto result = atrium({"sweep", "plan", "pipelines/comparisons/" + table, "--json"});
    ASSERT_EQ(result.exit_code, 0) << table << "\n" << result.err;
    EXPECT_GE(nlohmann::json::parse(result.out).at("variants").size(), 6U) << table;
  }
}

TEST(Comparisons, ThePapersMethodIsScoredOnASimulatedRoom) {
  const TemporaryFolder folder;
  write_text(folder / "s.yaml", "atrium: 1\nsweep: " + (source / "pipelines/comparisons/base.yaml").string() +
                                    "\nset: {scene.points: 60000, method/paper/objects.type: object.none}\n"
                                    "scenes: {room: {scene.pipeline: " +
                                    (source / "pipelines/comparisons/scenes/room.yaml").string() +
                                    "}}\nmetrics: {completeness: quality.structure.b50mm.completeness, "
                                    "components: validity.validity.components.all}\n"
                                    "pictures: {sheet.png: picture.png}\n");
  const auto result =
      atrium({"sweep", "run", (folder / "s.yaml").string(), "--out", (folder / "out").string(), "--quiet", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto row = nlohmann::json::parse(result.out).at("variants").at(0);
  EXPECT_GT(row.at("completeness").get<double>(), 0.9);
  EXPECT_GE(row.at("components").get<double>(), 8);
  EXPECT_TRUE(fs::exists(folder / "out/sheet.png"));
}

TEST(Comparisons, AnExternalProgramJoinsAPipeline) {
  const TemporaryFolder folder;
  write_text(folder / "copy.yaml", R"(atrium: 1
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 1000}}
  copy: {type: baseline.external, in: {mesh: scan.mesh}, params: {command: [cp, "{mesh}", "{output}"]}}
  faces: {type: metric.faces, in: {mesh: copy.mesh}}
  truth: {type: metric.faces, in: {mesh: scan.mesh}}
outputs: {copy: faces.metrics, truth: truth.metrics}
)");
  const auto result = atrium({"run", (folder / "copy.yaml").string(), "--out", (folder / "out").string(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto outputs = nlohmann::json::parse(result.out).at("outputs");
  EXPECT_EQ(outputs.at("copy").at("faces.triangles"), outputs.at("truth").at("faces.triangles"));
}

}  // namespace
}  // namespace atrium::test::comparisons_test
