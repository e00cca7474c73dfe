// pipelines/atrium.yaml on simulated scans: closed rooms, compared with the truth, whatever the scan's frame.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::atrium_test {
namespace {

using nlohmann::json;

constexpr const char* evaluation = R"(atrium: 1
vars: {shell: , structure: , truth: }
nodes:
  shell: {type: io.read_mesh, params: {path: "${shell}"}}
  structure: {type: io.read_mesh, params: {path: "${structure}"}}
  truth: {type: io.read_layout, params: {path: "${truth}"}}
  quality: {type: metric.structure, in: {mesh: structure.mesh, truth: truth.truth}}
  validity: {type: metric.validity, in: {mesh: shell.mesh}}
  compactness: {type: metric.compactness, in: {mesh: shell.mesh, truth: truth.truth}}
  plan: {type: floorplan.project, in: {mesh: shell.mesh}}
  rooms: {type: metric.rooms, in: {plan: plan.plan, truth: truth.truth}}
  write:
    type: metric.write
    in: {metrics: [quality.metrics, validity.metrics, compactness.metrics, rooms.metrics]}
    params: {path: metrics.json}
)";

void simulate(const std::string& scene, std::vector<std::string> settings, const fs::path& out) {
  settings.insert(settings.begin(),
                  {"scene.type=synth." + scene, "points=150000", "sensors=true", "outside=false", "windows=open"});
  const auto result = run_pipeline_file("simulate.yaml", settings, out);
  ASSERT_EQ(result.exit_code, 0) << result.err;
}
void reconstruct(const fs::path& scan, const fs::path& out, const std::vector<std::string>& more = {}) {
  const auto result = run_pipeline_file("atrium.yaml", {"scan=" + scan.string()}, out, more);
  ASSERT_EQ(result.exit_code, 0) << result.err;
}

struct Bar {
  std::string scene;
  double completeness, correctness, accuracy, ratio;
  int rooms;
};
class AtriumScene : public testing::TestWithParam<Bar> {};

TEST_P(AtriumScene, BecomesClosedRoomsThatAreTrue) {
  const Bar& bar = GetParam();
  const TemporaryFolder scratch;
  simulate(bar.scene, {"yaw=17 deg", "tilt=1 deg"}, scratch / "scan");
  reconstruct(scratch / "scan/scan.ply", scratch / "atrium");
  write_text(scratch / "evaluate.yaml", evaluation);
  const auto result = atrium({"run", (scratch / "evaluate.yaml").string(), "--quiet", "--out", (scratch / "m").string(),
                              "-s", "shell=" + (scratch / "atrium/shell.ply").string(), "-s",
                              "structure=" + (scratch / "atrium/structure.ply").string(), "-s",
                              "truth=" + (scratch / "scan/truth.json").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto value = [&](const std::string& name) { return metric(scratch / "m/metrics.json", name); };
  EXPECT_GE(value("structure.b50mm.completeness"), bar.completeness);
  EXPECT_GE(value("structure.b50mm.correctness"), bar.correctness);
  EXPECT_LE(value("structure.b50mm.accuracy"), bar.accuracy);
  EXPECT_EQ(value("validity.edges.boundary"), 0);
  EXPECT_EQ(value("validity.components.closed"), bar.rooms);
  EXPECT_EQ(value("validity.components.watertight"), bar.rooms);
  EXPECT_EQ(value("rooms.found"), bar.rooms);
  EXPECT_EQ(value("rooms.matched"), bar.rooms);
  EXPECT_LE(value("compactness.ratio"), bar.ratio);
}

// The attic's slanted ceilings take 20 triangles a room, 5/3 of the 12 of a box.
INSTANTIATE_TEST_SUITE_P(Scenes, AtriumScene,
                         testing::Values(Bar{"room", 0.98, 0.98, 0.0005, 1.3, 1},
                                         Bar{"flat", 0.97, 0.97, 0.0005, 1.3, 4},
                                         Bar{"two_storeys", 0.97, 0.96, 0.0005, 1.6, 6},
                                         Bar{"attic", 0.96, 0.96, 0.001, 1.67, 2}),
                         [](const auto& bar) { return bar.param.scene; });

/// The corners of a written mesh (binary PLY with x, y, z as doubles first), turned back by `yaw` after `offset`.
std::vector<Eigen::Vector3d> corners_of(const fs::path& file, double yaw, const Eigen::Vector3d& offset) {
  const std::string text = read_text(file);
  const std::size_t begin = text.find("end_header\n") + 11;
  const std::size_t count = std::stoul(text.substr(text.find("element vertex ") + 15));
  EXPECT_EQ(text.find("property double x"), text.find("property"));
  const std::size_t size = 3 * 8 + 3;  // and a colour
  const Eigen::AngleAxisd back(-yaw * M_PI / 180, Eigen::Vector3d::UnitZ());
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    std::memcpy(p.data(), text.data() + begin + i * size, sizeof(double) * 3);
    result.emplace_back(back * (p - offset));
  }
  return result;
}
double furthest(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  double most = 0;
  for (const auto& p : from) {
    double least = 1e9;
    for (const auto& q : to) least = std::min(least, (p - q).norm());
    most = std::max(most, least);
  }
  return most;
}

// The same points in other frames: the same corners within a millimetre.
TEST(Atrium, TheFrameOfTheScanDoesNotMatter) {
  const TemporaryFolder scratch;
  const auto corners = [&](const std::vector<std::string>& settings, double yaw, const Eigen::Vector3d& offset) {
    simulate("room", settings, scratch / "scan");
    reconstruct(scratch / "scan/scan.ply", scratch / "atrium");
    return corners_of(scratch / "atrium/shell.ply", yaw, offset);
  };
  const auto plain = corners({}, 0, {0, 0, 0});
  EXPECT_EQ(plain.size(), 12U);
  const auto expect_same = [&](const std::vector<Eigen::Vector3d>& other) {
    EXPECT_EQ(other.size(), plain.size());
    EXPECT_LT(furthest(plain, other), 0.001);
    EXPECT_LT(furthest(other, plain), 0.001);
  };
  expect_same(corners({"yaw=10 deg"}, 10, {0, 0, 0}));
  expect_same(corners({"yaw=77 deg"}, 77, {0, 0, 0}));
  expect_same(corners({"offset=[500000, 5400000, 300]"}, 0, {500000, 5400000, 300}));
}

TEST(Atrium, TheOrderOfPointsDoesNotMatter) {
  const TemporaryFolder scratch;
  simulate("flat", {}, scratch / "scan");
  reconstruct(scratch / "scan/scan.ply", scratch / "a");
  // The records of the points, last first.
  const std::string text = read_text(scratch / "scan/scan.ply");
  const std::size_t begin = text.find("end_header\n") + 11;
  const std::size_t size = 3 * 4 + 3 + 4 + 2;
  ASSERT_EQ(text.find("property float x"), text.find("property"));
  std::string reversed = text;
  constexpr std::size_t count = 150000;
  for (std::size_t i = 0; i < count; ++i)
    std::copy_n(text.begin() + static_cast<std::ptrdiff_t>(begin + i * size), size,
                reversed.begin() + static_cast<std::ptrdiff_t>(begin + (count - 1 - i) * size));
  ASSERT_NE(text, reversed);
  write_text(scratch / "reversed.ply", reversed);
  reconstruct(scratch / "reversed.ply", scratch / "b");
  const auto a = corners_of(scratch / "a/shell.ply", 0, {0, 0, 0}),
             b = corners_of(scratch / "b/shell.ply", 0, {0, 0, 0});
  EXPECT_EQ(a.size(), b.size());
  EXPECT_LT(furthest(a, b), 0.0001);
  EXPECT_LT(furthest(b, a), 0.0001);
}

TEST(Atrium, HasTheSameBytesWithAnyNumberOfThreads) {
  const TemporaryFolder scratch;
  simulate("two_storeys", {"yaw=30 deg"}, scratch / "scan");
  const auto hashes = [&](const std::string& threads) {
    reconstruct(scratch / "scan/scan.ply", scratch / "out", {"-j", threads});
    json list = json::array();
    for (const auto& node : json::parse(read_text(scratch / "out/manifest.json"))["nodes"])
      list.push_back({node["node"], node["outputs"]});
    return std::pair(list, read_text(scratch / "out/shell.ply") + read_text(scratch / "out/structure.ply"));
  };
  const auto serial = hashes("1");
  EXPECT_EQ(serial, hashes("2"));
  EXPECT_EQ(serial, hashes("4"));
}

}  // namespace
}  // namespace atrium::test::atrium_test
