// pipelines/evaluate.yaml and evaluate_run.yaml on what paper.yaml writes.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::evaluate_test {
namespace {

std::vector<std::string> files_of(const fs::path& run, const fs::path& scan, const fs::path& truth) {
  return {"structure=" + (run / "structure.ply").string(), "scene=" + (run / "scene.ply").string(),
          "planes=" + (run / "planes.vg").string(), "scan=" + scan.string(), "truth=" + truth.string()};
}

TEST(Evaluate, MeasuresAWholeRun) {
  const TemporaryFolder scratch;
  const auto simulated = run_pipeline_file(
      "simulate.yaml", {"scene.type=synth.room", "points=200000", "tilt=1 deg", "offset=[500000, 5400000, 300]"},
      scratch / "scan");
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const auto paper = run_pipeline_file(
      "paper.yaml", {"scan=" + (scratch / "scan/scan.ply").string(), "objects.type=object.none"}, scratch / "paper");
  ASSERT_EQ(paper.exit_code, 0) << paper.err;
  const auto evaluated = run_pipeline_file(
      "evaluate_run.yaml", files_of(scratch / "paper", scratch / "scan/scan.ply", scratch / "scan/truth.json"),
      scratch / "all");
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto json = scratch / "all/metrics.json";
  EXPECT_GT(metric(json, "structure.b50mm.completeness"), 0.8);
  EXPECT_LT(metric(json, "distance.structure.cloud_to_mesh.median"), 0.02);
  EXPECT_GT(metric(json, "primitives.purity"), 0.9);
  EXPECT_GT(metric(json, "compactness.ratio"), 0.5);
  EXPECT_EQ(metric(json, "rooms.true"), 1);
  EXPECT_GT(metric(json, "validity.triangles"), 11);
  const auto curve = read_text(scratch / "all/curve.csv");
  EXPECT_NE(curve.find("structure_curve.ceiling.b150mm.completeness,"), std::string::npos);
}

TEST(Evaluate, TakesAHeadsetsLayoutForTruth) {
  const fs::path folder = scans / "quest_office_small";
  if (!fs::exists(folder)) GTEST_SKIP() << "skipped: there is no " << folder;
  const TemporaryFolder scratch;
  const auto paper = run_pipeline_file(
      "paper.yaml", {"scan=" + (folder / "mesh.ply").string(), "objects.type=object.none"}, scratch / "paper");
  ASSERT_EQ(paper.exit_code, 0) << paper.err;
  const auto evaluated = run_pipeline_file(
      "evaluate_run.yaml", files_of(scratch / "paper", folder / "mesh.ply", folder / "layout.json"), scratch / "all");
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  EXPECT_GT(metric(scratch / "all/metrics.json", "structure.b100mm.completeness"), 0.6);
  EXPECT_EQ(metric(scratch / "all/metrics.json", "compactness.least_triangles"), 12);
}

}  // namespace
}  // namespace atrium::test::evaluate_test
