// Floor plans of simulated buildings, made by the program and compared with the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/pipelines/steps.hpp"
#include "tests/support/lacking.hpp"

namespace atrium::test::floorplan_test {
namespace {

using nlohmann::json;

// Rooms of synth.flat with its default sizes (10.2 m × 8 m, walls of 12 cm): the largest first.
const double xs = 0.56 * 10.2, left = 0.58 * 8, right = 0.47 * 8, t = 0.12;
const std::vector<double> flat_rooms{xs * left, xs*(8 - left - t), (10.2 - xs - t) * (8 - right - t),
                                     (10.2 - xs - t) * right};

/// The plan in a run's folder; by the rules of RFC 7946.
json plan_of(const fs::path& folder) {
  const fs::path file = folder / "floorplan.geojson";
  const auto result = run_validator("validate-geojson", {file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  return json::parse(read_text(file));
}

std::vector<json> of_class(const json& plan, const std::string& name) {
  std::vector<json> result;
  for (const auto& feature : plan["features"])
    if (feature["properties"]["class"] == name) result.push_back(feature);
  return result;
}

std::vector<double> room_areas(const json& plan) {
  std::vector<double> areas;
  for (const auto& room : of_class(plan, "room")) areas.push_back(room["properties"]["area_m2"]);
  std::sort(areas.rbegin(), areas.rend());
  return areas;
}

void expect_inner_walls(const json& plan, double least_length) {
  double length = 0;
  for (const auto& wall : of_class(plan, "wall")) {
    if (wall["properties"]["thickness_m"].is_null()) continue;
    EXPECT_NEAR(wall["properties"]["thickness_m"], 0.12, 0.01);
    length += wall["properties"]["length_m"].get<double>();
  }
  EXPECT_GT(length, least_length);
}

fs::path run_paper(const TemporaryFolder& scratch, std::vector<std::string> simulation) {
  simulation.insert(simulation.end(), {"points=300000", "noise=8 mm", "sensors=true", "outside=false", "windows=open"});
  const auto simulated = run_pipeline_file("simulate.yaml", simulation, scratch / "scan");
  EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
  const auto paper = run_pipeline_file(
      "paper.yaml", {"scan=" + (scratch / "scan/scan.ply").string(), "objects.type=object.none"}, scratch / "paper");
  EXPECT_EQ(paper.exit_code, 0) << paper.err;
  return scratch / "paper";
}

// The last of the four is the bedroom: the front of its wardrobes stands for a wall.
TEST(FloorPlan, OfAFurnishedTurnedAndTiltedFlatIsTrue) {
  const TemporaryFolder scratch;
  const auto folder = run_paper(scratch, {"yaw=23 deg", "tilt=2.5 deg"});
  const json plan = plan_of(folder);
  const auto areas = room_areas(plan);
  ASSERT_EQ(areas.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(areas[i] / flat_rooms[i], 1, i < 3 ? 0.03 : 0.10) << i;
  expect_inner_walls(plan, 10);
  EXPECT_GT(fs::file_size(folder / "floorplan.svg"), 5000U);
  EXPECT_GT(fs::file_size(folder / "floorplan.dxf"), 5000U);
}

TEST(FloorPlan, OfAGeoreferencedEmptyFlatStandsWhereTheFlatIs) {
  const TemporaryFolder scratch;
  const json plan = plan_of(run_paper(scratch, {"scene.furniture=0", "offset=[500000, 5400000, 300]"}));
  const auto areas = room_areas(plan);
  ASSERT_EQ(areas.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(areas[i] / flat_rooms[i], 1, 0.01) << i;
  expect_inner_walls(plan, 13);
  double low[2] = {1e9, 1e9}, high[2] = {0, 0};
  for (const auto& room : of_class(plan, "room")) {
    EXPECT_NEAR(room["properties"]["elevation_m"], 300, 0.01);
    for (const auto& corner : room["geometry"]["coordinates"][0])
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], corner[k].get<double>());
        high[k] = std::max(high[k], corner[k].get<double>());
      }
  }
  EXPECT_NEAR(low[0], 500000, 0.02);
  EXPECT_NEAR(high[0], 500010.2, 0.02);
  EXPECT_NEAR(low[1], 5400000, 0.02);
  EXPECT_NEAR(high[1], 5400008, 0.02);
}

class TruePlan : public testing::TestWithParam<std::pair<std::string, std::size_t>> {};

// floorplan.yaml on a mesh file: the true structure, doors and windows left open.
TEST_P(TruePlan, HasItsRooms) {
  const auto& [scene, rooms] = GetParam();
  const TemporaryFolder scratch;
  const auto simulated =
      run_pipeline_file("simulate.yaml", {"scene.type=synth." + scene, "points=1000", "yaw=23 deg"}, scratch / "scan");
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const auto drawn =
      run_pipeline_file("floorplan.yaml", {"structure=" + (scratch / "scan/truth.ply").string()}, scratch / "plan");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const json plan = plan_of(scratch / "plan");
  const auto areas = room_areas(plan);
  ASSERT_EQ(areas.size(), rooms);
  if (scene == "flat") {
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(areas[i], flat_rooms[i], 1e-3) << i;
    expect_inner_walls(plan, 8);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TruePlan,
                         testing::Values(std::pair<std::string, std::size_t>{"room", 1}, std::pair{"flat", 4},
                                         std::pair{"two_storeys", 6}, std::pair{"attic", 2}),
                         [](const auto& scene) { return scene.param.first; });

// Area of the floor of the layout that a scan comes with.
double layout_area(const std::string& name) {
  double twice = 0;
  const json layout = json::parse(read_text(scans / name / "layout.json"));
  for (const auto& plane : layout["planes"]) {
    if (plane["label"] != "FLOOR") continue;
    const auto& corners = plane["corners"];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
      twice += a[0].get<double>() * b[1].get<double>() - b[0].get<double>() * a[1].get<double>();
    }
  }
  return std::abs(0.5 * twice);
}

// How far the method's structure falls short: it finds no niches, and small pieces of floor are clipped away.
TEST(FloorPlan, OfRealRoomsHasTheirArea) {
  for (const auto& [name, share] : std::vector<std::pair<std::string, double>>{
           {"quest_office_small", 0.02}, {"quest_living_room", 0.05}, {"quest_meeting_room", 0.12}}) {
    const fs::path scan = scans / name / "mesh.ply";
    if (!fs::exists(scan)) GTEST_SKIP() << scan << " is not there";
    const TemporaryFolder scratch;
    const auto paper =
        run_pipeline_file("paper.yaml", {"scan=" + scan.string(), "objects.type=object.none"}, scratch / "paper");
    ASSERT_EQ(paper.exit_code, 0) << paper.err;
    double sum = 0;
    for (const double area : room_areas(plan_of(scratch / "paper"))) sum += area;
    EXPECT_NEAR(sum / layout_area(name), 1, share) << name;
  }
}

}  // namespace
}  // namespace atrium::test::floorplan_test
