// The paper's method, run as a user runs it: simulate or take a scan, `atrium run pipelines/paper.yaml`, look at the
// files.
#include <gtest/gtest.h>

#include <functional>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::paper_test {
namespace {

const std::vector<std::string> results{"structure.ply", "objects.ply",      "scene.ply", "scene_without_ceiling.ply",
                                       "planes.vg",     "metrics.json",     "scene.glb", "floorplan.svg",
                                       "floorplan.dxf", "floorplan.geojson"};

std::string simulate(const TemporaryFolder& scratch, const std::vector<std::string>& settings) {
  const auto run = run_pipeline_file("simulate.yaml", settings, scratch / "scan");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return "scan=" + (scratch / "scan/scan.ply").string();
}

TEST(Paper, FindsTheStructureOfATurnedAndTiltedFlat) {
  const TemporaryFolder scratch;
  const auto scan = simulate(scratch, {"points=1000000", "noise=8 mm", "yaw=23 deg", "tilt=2.5 deg"});
  const auto paper = run_pipeline_file("paper.yaml", {scan, "objects.type=object.none"}, scratch / "paper");
  ASSERT_EQ(paper.exit_code, 0) << paper.err;
  const auto evaluated = run_pipeline_file(
      "evaluate.yaml",
      {"structure=" + (scratch / "paper/structure.ply").string(), "truth=" + (scratch / "scan/truth.json").string()},
      scratch / "evaluated");
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  EXPECT_GE(metric(scratch / "evaluated/metrics.json", "structure.b50mm.completeness"), 0.90);
  EXPECT_GE(metric(scratch / "evaluated/metrics.json", "structure.b50mm.correctness"), 0.85);
}

TEST(Paper, GivesTheSameBytesWithAnyNumberOfThreads) {
  const TemporaryFolder scratch;
  const auto scan = simulate(scratch, {"points=100000"});
  std::vector<fs::path> runs;
  for (const std::string threads : {"1", "2", "4"})
    for (const std::string round : {"a", "b", "c"}) {
      runs.push_back(scratch / ("run-" + threads + round));
      const auto run = run_pipeline_file("paper.yaml", {scan, "objects.depth=6"}, runs.back(), {"-j", threads});
      ASSERT_EQ(run.exit_code, 0) << run.err;
    }
  for (const auto& file : results) {
    const std::string first = read_text(runs.front() / file);
    EXPECT_FALSE(first.empty()) << file;
    for (const auto& run : runs) EXPECT_TRUE(read_text(run / file) == first) << run << "/" << file;
  }
}

TEST(Paper, ResolvedFileGivesTheSameBytes) {
  const TemporaryFolder scratch;
  const auto scan = simulate(scratch, {"points=100000"});
  const auto first = run_pipeline_file(
      "paper.yaml", {scan, "objects.type=object.none", "planes.distance=15 mm", "seed=7"}, scratch / "first");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto again =
      atrium({"run", (scratch / "first/resolved.yaml").string(), "--quiet", "--out", (scratch / "again").string()});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (const auto& file : results)
    EXPECT_TRUE(read_text(scratch / ("first/" + file)) == read_text(scratch / ("again/" + file))) << file;
}

TEST(Paper, NodesAreSwappedAndConstantsChangedFromTheCommandLine) {
  const TemporaryFolder scratch;
  const auto scan = simulate(scratch, {"points=100000"});
  const auto swapped = run_pipeline_file("paper.yaml",
                                         {scan, "objects.type=object.none", "planes.type=plane.region_growing",
                                          "translated.max_separation=10 cm", "aligned.type=align.none"},
                                         scratch / "swapped");
  EXPECT_EQ(swapped.exit_code, 0) << swapped.err;
  EXPECT_NE(read_text(scratch / "swapped/resolved.yaml").find("plane.region_growing"), std::string::npos);
  const auto wrong = run_pipeline_file("paper.yaml", {scan, "planes.distanse=1 cm"}, scratch / "wrong");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_NE(wrong.err.find("did you mean 'distance'"), std::string::npos) << wrong.err;
  EXPECT_FALSE(fs::exists(scratch / "wrong"));
}

TEST(Paper, ThetaAndTheNumberOfPrimitivesAreVariables) {
  const TemporaryFolder scratch;
  const auto scan = simulate(scratch, {"points=200000", "scene.type=synth.attic"});
  const auto found = [&](const std::string& setting, const std::string& name) {
    const fs::path out = scratch / setting;
    const auto run = run_pipeline_file("paper.yaml", {scan, "objects.type=object.none", setting}, out);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return metric(out / "metrics.json", name);
  };
  EXPECT_GT(found("theta=60deg", "structure.ceilings"), found("theta=20deg", "structure.ceilings"));
  EXPECT_EQ(found("primitives=12", "structure.planes"), 12);
}

TEST(Paper, GeoreferencedScanComesBackWhereItWas) {
  const TemporaryFolder scratch;
  const auto there = simulate(scratch, {"points=200000", "offset=[500000, 5400000, 300]"});
  const auto far = run_pipeline_file("paper.yaml", {there, "objects.type=object.none"}, scratch / "far");
  ASSERT_EQ(far.exit_code, 0) << far.err;
  const auto evaluated = run_pipeline_file(
      "evaluate.yaml",
      {"structure=" + (scratch / "far/structure.ply").string(), "truth=" + (scratch / "scan/truth.json").string()},
      scratch / "evaluated");
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  EXPECT_LT(metric(scratch / "evaluated/metrics.json", "structure.b50mm.accuracy"), 0.001);
  EXPECT_GE(metric(scratch / "evaluated/metrics.json", "structure.b50mm.completeness"), 0.85);
}

class RealScan : public testing::TestWithParam<std::string> {};

TEST_P(RealScan, BecomesAModelWithWalls) {
  const fs::path scan = scans / GetParam();
  if (!fs::exists(scan)) GTEST_SKIP() << "skipped: there is no " << scan;
  const TemporaryFolder scratch;
  const auto run = run_pipeline_file("paper.yaml", {"scan=" + scan.string()}, scratch / "out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const auto& file : results) EXPECT_TRUE(fs::exists(scratch / ("out/" + file))) << file;
  EXPECT_GE(metric(scratch / "out/metrics.json", "structure.walls"), 2);
}
INSTANTIATE_TEST_SUITE_P(Scans, RealScan,
                         testing::Values("quest_office_small/mesh.ply", "quest_meeting_room/mesh.ply",
                                         "quest_living_room/mesh.ply", "lidar_room/room_scan1.pcd",
                                         "lidar_room/room_scan2.pcd", "lidar_flat/cloud_0.ply",
                                         "lidar_flat/cloud_1.ply", "ipad_ceilings/808_db.ply",
                                         "ipad_ceilings/430_db.ply"),
                         [](const auto& test) {
                           std::string name = fs::path(test.param).replace_extension().string();
                           for (auto& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

TEST(Paper, SaysThatThereIsNoRoomInAScanOfFurniture) {
  const fs::path scan = scans / "objects_only/room1_gt_fine.pcd";
  if (!fs::exists(scan)) GTEST_SKIP() << "skipped: there is no " << scan;
  const TemporaryFolder scratch;
  const auto run = run_pipeline_file("paper.yaml", {"scan=" + scan.string()}, scratch / "out");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no room"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(scratch / "out/structure.ply"));
}

TEST(Paper, SaysThatAFrameOfACameraIsNotUpright) {
  const fs::path scan = scans / "rgbd_frame/office1.pcd";
  if (!fs::exists(scan)) GTEST_SKIP() << "skipped: there is no " << scan;
  const TemporaryFolder scratch;
  const auto run = run_pipeline_file("paper.yaml", {"scan=" + scan.string()}, scratch / "out");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no plane is a wall"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(scratch / "out/structure.ply"));
}

/// A room of 5 by 4 by 2.5 units, 60,000 points on the sides that are wanted.
std::string room_points(double unit, bool walls, bool floor, bool ceiling) {
  std::string text;
  const auto add = [&](double x, double y, double z) {
    text += std::to_string(x * unit) + " " + std::to_string(y * unit) + " " + std::to_string(z * unit) + "\n";
  };
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k) {
      const double u = (i + 0.5) / 100;
      const double v = (k + 0.5) / 100;
      if (floor) add(5 * u, 4 * v, 0);
      if (ceiling) add(5 * u, 4 * v, 2.5);
      if (!walls) continue;
      add(5 * u, 0, 2.5 * v);
      add(5 * u, 4, 2.5 * v);
      add(0, 4 * u, 2.5 * v);
      add(5, 4 * u, 2.5 * v);
    }
  return text;
}

TEST(Paper, HasAnAnswerToEachPartOfARoomThatLacks) {
  const TemporaryFolder scratch;
  const auto run = [&](const std::string& name, const std::string& text) {
    write_text(scratch / (name + ".xyz"), text);
    return run_pipeline_file("paper.yaml", {"scan=" + (scratch / (name + ".xyz")).string(), "objects.type=object.none"},
                             scratch / name);
  };
  const auto warned = [&](const std::string& name, const std::string& text) {
    return read_text(scratch / (name + "/manifest.json")).find(text) != std::string::npos;
  };
  const auto whole = run("whole", room_points(1, true, true, true));
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(metric(scratch / "whole/metrics.json", "structure.walls"), 4);
  const auto open = run("no_ceiling", room_points(1, true, true, false));
  EXPECT_EQ(open.exit_code, 0) << open.err;
  EXPECT_TRUE(warned("no_ceiling", "no ceiling"));
  const auto hanging = run("no_floor", room_points(1, true, false, true));
  EXPECT_EQ(hanging.exit_code, 0) << hanging.err;
  EXPECT_TRUE(warned("no_floor", "no floor"));
  EXPECT_EQ(run("no_walls", room_points(1, false, true, true)).exit_code, 1);
  EXPECT_EQ(run("only_walls", room_points(1, true, false, false)).exit_code, 1);
  const auto millimetres = run("millimetres", room_points(1000, true, true, true));
  EXPECT_EQ(millimetres.exit_code, 1);
  EXPECT_TRUE(warned("millimetres", "millimetres"));
  EXPECT_FALSE(warned("whole", "millimetres"));
}

TEST(Paper, LeavesNothingOfAKilledRunToALaterOne) {
  const TemporaryFolder scratch;
  write_text(scratch / "room.xyz", room_points(1, true, true, true));
  const std::string scan = "scan=" + (scratch / "room.xyz").string();
  bool killed = false;
  ProcessOptions options;
  options.folder = source;
  options.watch = [&](pid_t process, const std::string&) {
    if (killed || !fs::exists(scratch / "out/structure.ply")) return;
    killed = ::kill(process, SIGKILL) == 0;
  };
  run_process({ATRIUM_PROGRAM, "run", "pipelines/paper.yaml", "-s", scan, "--out", (scratch / "out").string()},
              options);
  ASSERT_TRUE(fs::exists(scratch / "out/structure.ply"));
  write_text(scratch / "room.xyz", room_points(1, true, false, false));
  EXPECT_EQ(run_pipeline_file("paper.yaml", {scan}, scratch / "out").exit_code, 1);
  EXPECT_FALSE(fs::exists(scratch / "out/structure.ply"));
}

struct BadScan {
  std::string name, text, message;
};
class BadInput : public testing::TestWithParam<BadScan> {};

TEST_P(BadInput, IsAClearErrorAndNoModel) {
  const TemporaryFolder scratch;
  const fs::path scan = scratch / GetParam().name;
  std::ofstream(scan, std::ios::binary) << GetParam().text;
  const auto run = run_pipeline_file("paper.yaml", {"scan=" + scan.string()}, scratch / "out");
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_NE(run.err.find(GetParam().message), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(scratch / "out/structure.ply"));
}

std::string lines(int n, const std::function<std::string(int)>& line) {
  std::string text;
  for (int i = 0; i < n; ++i) text += line(i) + "\n";
  return text;
}
std::string grid_point(int i) { return std::to_string(i % 200 * 0.02) + " " + std::to_string(i / 200 * 0.02) + " 0"; }

const std::string ply_header =
    "ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\n"
    "property float y\nproperty float z\nend_header\n";

INSTANTIATE_TEST_SUITE_P(
    Scans, BadInput,
    testing::Values(BadScan{"empty.ply", "", "empty"},
                    BadScan{"truncated.ply", ply_header + std::string(500, 'x'), "truncated"},
                    BadScan{"two.xyz", "0 0 0\n1 1 1\n", "three points"},
                    BadScan{"nan.xyz", lines(100, [](int) { return std::string("nan inf 0"); }), "finite"},
                    BadScan{"plane.xyz", lines(40000, grid_point), "no room"},
                    BadScan{"one_place.xyz", lines(5000, [](int) { return std::string("1 2 3"); }), "plan"}),
    [](const auto& test) { return fs::path(test.param.name).stem().string(); });

}  // namespace
}  // namespace atrium::test::paper_test
