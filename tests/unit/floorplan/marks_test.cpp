// Marks of what was corrected by hand, and of what nobody has seen, on all drawings of a plan.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "modules/floorplan/dimensions.hpp"
#include "modules/floorplan/write_dxf.hpp"
#include "modules/floorplan/write_geojson.hpp"
#include "modules/floorplan/write_svg.hpp"
#include "tests/support/lacking.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan::marks_test {
namespace {

using nlohmann::json;

class Marks : public testing::Test {
 protected:
  std::shared_ptr<Host> host = std::make_shared<Host>();
  Context context{1, host};

  std::string dxf(const FloorPlan& plan) {
    WriteDxf::run({input(plan)}, {}, context);
    return test::read_text(host->folder / "floorplan.dxf");
  }
  json geojson(const FloorPlan& plan) {
    WriteGeojson::run({input(plan)}, {}, context);
    return json::parse(test::read_text(host->folder / "floorplan.geojson"));
  }
  std::string svg(const FloorPlan& plan, const Metrics* metrics = nullptr) {
    WriteSvg::In in{input(plan), {}};
    if (metrics != nullptr) in.accuracy = input(*metrics);
    WriteSvg::run(in, {}, context);
    return test::read_text(host->folder / "floorplan.svg");
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The first wall, the second room, and a window in the wall y = 0 were corrected.
FloorPlan corrected_plan() {
  FloorPlan plan = plan_of(two_rooms());
  PlanStorey& storey = plan.storeys[0];
  storey.walls[0].corrected = true;
  storey.rooms[1].corrected = true;
  PlanOpening window;
  window.kind = "window";
  window.from = Eigen::Vector2d(1, 0) - plan.origin.head<2>();
  window.to = Eigen::Vector2d(2, 0) - plan.origin.head<2>();
  window.corrected = true;
  storey.openings = {window};
  return plan;
}

TEST_F(Marks, TheDxfHasADiamondForEachCorrection) {
  EXPECT_FALSE(has(dxf(plan_of(two_rooms())), "A-ANNO-REVS"));
  const std::string text = dxf(corrected_plan());
  EXPECT_EQ(count(text, "\nLAYER\n"), count(dxf(plan_of(two_rooms())), "\nLAYER\n") + 1);
  // The layer's own row, and three closed lines.
  EXPECT_EQ(count(text, "A-ANNO-REVS\n"), 4U);
  const std::string python = test::python_with("ezdxf");
  if (python.empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  dxf(corrected_plan());
  const auto result = test::run_process(
      {python, ATRIUM_SOURCE_DIR "/tests/unit/floorplan/read_dxf.py", (host->folder / "floorplan.dxf").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json root = json::parse(result.out);
  EXPECT_EQ(root["errors"], json::array());
  EXPECT_EQ(root["structure"], json::array());
  std::vector<Eigen::Vector2d> middles;
  for (const auto& entity : root["entities"]) {
    if (entity["layer"] != "A-ANNO-REVS") continue;
    EXPECT_EQ(entity["type"], "LWPOLYLINE");
    ASSERT_EQ(entity["points"].size(), 4U);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const auto& p : entity["points"]) sum += Eigen::Vector2d(p[0], p[1]) / 4;
    middles.push_back(sum);
  }
  ASSERT_EQ(middles.size(), 3U);
  const FloorPlan plan = corrected_plan();
  const PlanWall& wall = plan.storeys[0].walls[0];
  const Eigen::Vector2d origin = plan.origin.head<2>();
  EXPECT_LT((middles[0] - origin - 0.5 * (wall.from + wall.to)).norm(), 1e-6);
  EXPECT_LT((middles[1] - Eigen::Vector2d(1.5, 0)).norm(), 1e-6);
}

TEST_F(Marks, LayersOfStoreysHaveTheirOwn) {
  MeshBuilder b;
  b.room(0, 0, 4, 3);
  b.storey = 1;
  b.room(0, 0, 4, 3, 2.8, 5.3);
  FloorPlan plan = plan_of(b.mesh);
  ASSERT_EQ(plan.storeys.size(), 2U);
  plan.storeys[1].rooms[0].corrected = true;
  const std::string text = dxf(plan);
  EXPECT_TRUE(has(text, "A-ANNO-REVS-S1\n"));
  EXPECT_FALSE(has(text, "A-ANNO-REVS-S0\n"));
}

TEST_F(Marks, TheGeojsonHasAPropertyOfRoomsToo) {
  const auto marked = [](const json& root) {
    std::map<std::string, int> found;
    for (const auto& feature : root["features"])
      if (feature["properties"].contains("corrected")) {
        EXPECT_EQ(feature["properties"]["corrected"], true);
        ++found[feature["properties"]["class"]];
      }
    return found;
  };
  EXPECT_TRUE(marked(geojson(plan_of(two_rooms()))).empty());
  EXPECT_EQ(marked(geojson(corrected_plan())), (std::map<std::string, int>{{"room", 1}, {"wall", 1}, {"window", 1}}));
}

TEST_F(Marks, DimensionsToAWallThatWasNotSeenAreInParentheses) {
  const FloorPlan seen = plan_of(two_rooms());
  EXPECT_FALSE(has(svg(seen), "was not seen"));
  for (const auto& chain : dimensions_of(seen.storeys[0], 0.1))
    for (const auto& label : chain.labels) EXPECT_FALSE(label.inferred) << label.text;
  // The right end of the second room was not seen: what ends there is inferred, what does not is not.
  FloorPlan plan = seen;
  for (auto& wall : plan.storeys[0].walls)
    if (plan.origin.x() + std::min(wall.from.x(), wall.to.x()) > 6.9) wall.inferred = true;
  std::map<std::string, bool> texts;
  for (const auto& chain : dimensions_of(plan.storeys[0], 0.1))
    if (!chain.upright())
      for (const auto& label : chain.labels) texts[label.text] = label.inferred;
  EXPECT_EQ(texts, (std::map<std::string, bool>{{"4.00", false}, {"0.12", false}, {"(2.88)", true}, {"(7.00)", true}}));
  const std::string drawn = svg(plan);
  EXPECT_TRUE(has(drawn, ">(2.88)<")) << drawn;
  EXPECT_TRUE(has(drawn, "(1.00) ends at a wall that was not seen"));
  // Programs that measure a dimension anew keep the parentheses.
  EXPECT_GE(count(dxf(plan), "\n(<>)\n"), 2U);
  EXPECT_EQ(count(dxf(seen), "(<>)"), 0U);
}

TEST_F(Marks, TheTitleBlockSaysHowFarTheScanIs) {
  const FloorPlan plan = plan_of(two_rooms());
  EXPECT_FALSE(has(svg(plan), "scan to model"));
  const Metrics metrics{{{"accuracy.all.points", 90, ""},
                         {"accuracy.all.median", -0.0012, "m"},
                         {"accuracy.all.rms", 0.004, "m"},
                         {"accuracy.all.p95", 0.0123, "m"}}};
  EXPECT_TRUE(has(svg(plan, &metrics), "scan to model: median -1.2 mm, 95 % within 12.3 mm (LOA30)"));
  const Metrics others{{{"accuracy.wall.median", 0.001, "m"}}};
  EXPECT_EQ(svg(plan, &others), svg(plan));
}

TEST_F(Marks, BandsOfAccuracyAreThoseOfItsTable) {
  const auto band = [](double p95) {
    const Metrics metrics{{{"accuracy.all.median", 0, "m"}, {"accuracy.all.p95", p95, "m"}}};
    const std::string text = accuracy_text(&metrics);
    return text.substr(text.find('(') + 1, 5);
  };
  EXPECT_EQ(band(0.06), "LOA10");
  EXPECT_EQ(band(0.05), "LOA20");
  EXPECT_EQ(band(0.015), "LOA30");
  EXPECT_EQ(band(0.004), "LOA40");
  EXPECT_EQ(band(0.0009), "LOA50");
  EXPECT_EQ(accuracy_text(nullptr), "");
}

}  // namespace
}  // namespace atrium::floorplan::marks_test
