// What goes into the paper's method, and what is compared with it, by pipelines of their own: scans that are joined,
// and plans of other programs.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::paper_inputs_test {
namespace {

TEST(JoinScans, BringsOneScanOntoTheOther) {
  const fs::path first = scans / "lidar_flat/cloud_0.ply";
  const fs::path second = scans / "lidar_flat/cloud_1.ply";
  if (!fs::exists(first) || !fs::exists(second)) GTEST_SKIP() << "skipped: there is no " << first;
  const TemporaryFolder scratch;
  const auto run =
      run_pipeline_file("join_scans.yaml", {"first=" + first.string(), "second=" + second.string()}, scratch / "out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::exists(scratch / "out/scan.ply"));
  EXPECT_GE(metric(scratch / "out/metrics.json", "register.1.overlap"), 0.9);
}

TEST(ExtrudePlan, StandsOnTheFloorOfTheScanAndReachesItsCeiling) {
  const TemporaryFolder scratch;
  const auto simulated =
      run_pipeline_file("simulate.yaml", {"points=100000", "scene.type=synth.room", "outside=false"}, scratch / "scan");
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  // A list of rooms' corners, as a line in 360-DFPE writes it. The room is not of this shape: only heights are its own.
  write_text(scratch / "rooms.json", "[[[0.5, 0.5], [2.5, 0.5], [2.5, 2.0], [0.5, 2.0]]]");
  const auto run = run_pipeline_file(
      "extrude_plan.yaml",
      {"scan=" + (scratch / "scan/scan.ply").string(), "plan=" + (scratch / "rooms.json").string()}, scratch / "out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(metric(scratch / "out/metrics.json", "faces.floor.area"), 3.0, 1e-3);
  EXPECT_NEAR(metric(scratch / "out/metrics.json", "faces.ceiling.area"), 3.0, 1e-3);
  EXPECT_NEAR(metric(scratch / "out/metrics.json", "faces.wall.area") / 7.0, 2.6, 0.05);  // perimeter times height
}

}  // namespace
}  // namespace atrium::test::paper_inputs_test
