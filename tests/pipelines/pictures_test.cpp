// The pipelines that draw: what is on a picture is looked at in the render module's tests.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::pictures_test {
namespace {

/// Width and height from a PNG's header; 0 and 0 if it is none.
std::pair<int, int> size_of_png(const fs::path& file) {
  const std::string bytes = read_text(file);
  if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG") return {0, 0};
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  return {number(16), number(20)};
}

class Pictures : public testing::Test {
 protected:
  Pictures() {
    const auto simulated =
        run_pipeline_file("simulate.yaml", {"points=60000", "scene.type=synth.room"}, folder / "scan");
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
    scan = "scan=" + (folder / "scan/scan.ply").string();
  }
  TemporaryFolder folder;
  std::string scan;
};

TEST_F(Pictures, AllStagesStandOnOneSheet) {
  const auto result = run_pipeline_file("stages.yaml", {scan, "model/objects.depth=6"}, folder / "out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto [width, height] = size_of_png(folder / "out/stages.png");
  EXPECT_GT(width, 4 * 400);
  EXPECT_GT(height, 2 * 300);
  for (const char* stage : {"a_scan", "b_primitives", "c_structural_points", "d_object_points", "e_structure",
                            "f_objects", "g_scene", "h_scene_with_ceiling"})
    EXPECT_EQ(size_of_png(folder / "out" / (std::string(stage) + ".png")), std::pair(840, 630)) << stage;
}

TEST_F(Pictures, AreOfTheMethodThatTakesItsPlace) {
  const auto result = run_pipeline_file(
      "stages.yaml",
      {scan, "model.pipeline=pipelines/atrium.yaml", "model/objects.type=object.poisson", "model/objects.depth=6"},
      folder / "out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(size_of_png(folder / "out/stages.png").first, 4 * 400);
}

TEST_F(Pictures, AMethodWithoutObjectsLeavesTheirPictureBlank) {
  const auto result = run_pipeline_file("stages.yaml", {scan, "model.pipeline=pipelines/atrium.yaml"}, folder / "out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(size_of_png(folder / "out/stages.png").first, 4 * 400);
  EXPECT_EQ(size_of_png(folder / "out/f_objects.png"), std::pair(840, 630));
}

TEST_F(Pictures, AColouredScanIsSeenFromWithinAndFromAbove) {
  const auto result =
      run_pipeline_file("textured.yaml", {scan, "model/objects.depth=6", "views.width=320"}, folder / "out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(size_of_png(folder / "out/textured_inside.png").first, 320);
  EXPECT_EQ(size_of_png(folder / "out/textured_isometric.png").first, 320);
}

}  // namespace
}  // namespace atrium::test::pictures_test
