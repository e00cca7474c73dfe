// pipelines/simulate.yaml and pipelines/evaluate.yaml, run by the program on each scene.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::simulate_test {
namespace {

class Simulate : public testing::TestWithParam<std::string> {
 protected:
  ProcessResult atrium(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
    ProcessOptions options;
    options.folder = folder.path();
    return run_process(arguments, options);
  }
  TemporaryFolder folder;
};

TEST_P(Simulate, ScanAndTruthAreWrittenAndTheTruthIsPerfect) {
  const std::string pipelines = ATRIUM_SOURCE_DIR "/pipelines/";
  const auto simulated =
      atrium({"run", pipelines + "simulate.yaml", "-s", "scene.type=synth." + GetParam(), "-s", "points=5000", "-s",
              "yaw=23 deg", "-s", "tilt=2.5 deg", "-s", "offset=[500000, 5400000, 300]", "--out", "scan"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_GT(std::filesystem::file_size(folder / "scan/scan.ply"), 5000U * 12);
  const auto evaluated = atrium({"run", pipelines + "evaluate.yaml", "-s", "structure=scan/truth.ply", "-s",
                                 "truth=scan/truth.json", "--out", "quality"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto metrics = nlohmann::json::parse(read_text(folder / "quality/metrics.json"));
  // The truth is as good as can be, by every measure: all of it there and right, in the least buffer too.
  for (const char* buffer : {"b20mm", "b50mm", "b100mm"}) {
    for (const char* surface : {"", "wall", "floor", "ceiling"}) {
      const auto& all = metrics["structure"];
      const auto& scores = *surface == '\0' ? all[buffer] : all[surface][buffer];
      EXPECT_EQ(scores["completeness"]["value"], 1.0) << surface << buffer;
      EXPECT_EQ(scores["correctness"]["value"], 1.0) << surface << buffer;
      EXPECT_LT(scores["accuracy"]["value"], 1e-6) << surface << buffer;
    }
  }
  const auto& rooms = metrics["rooms"];
  for (const auto& scores : {rooms, rooms["corners"], rooms["angles"]})
    for (const char* share : {"precision", "recall", "f1"}) EXPECT_EQ(scores[share]["value"], 1.0) << share;
  EXPECT_GT(rooms["iou"]["value"], 1 - 1e-6);
  EXPECT_LT(rooms["corners"]["error"]["value"], 1e-5);  // short sides meet at flat angles: rounding moves their corner
  EXPECT_LT(rooms["angles"]["error"]["value"], 1e-3);
  const auto& validity = metrics["validity"];
  for (const char* flaw : {"degenerate_faces", "duplicate_faces"}) EXPECT_EQ(validity[flaw]["value"], 0.0) << flaw;
  for (const char* flaw : {"non_manifold", "misoriented"}) EXPECT_EQ(validity["edges"][flaw]["value"], 0.0) << flaw;
  for (const char* flaw : {"deep", "overlapping"})
    EXPECT_EQ(validity["self_intersections"][flaw]["value"], 0.0) << flaw;
  // The faces are not welded, and the predicates exact: where they meet at other than right angles, rounding decides on
  // which side of its neighbour an edge lies.
  if (GetParam() != "polygon_room" && GetParam() != "round_room") {
    EXPECT_EQ(validity["self_intersections"]["through_edges"]["value"], 0.0);
  }
  EXPECT_GT(metrics["faces"]["triangles"]["value"], 12.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Simulate,
                         testing::Values("room", "flat", "two_storeys", "attic", "office", "polygon_room", "round_room",
                                         "split_level", "raised_room", "tall_building"),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace atrium::test::simulate_test
