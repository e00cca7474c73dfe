#include "modules/building/accuracy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/box_building.hpp"
#include "tests/support/svg_drawing.hpp"
#include "writing_host.hpp"

namespace atrium::building::accuracy_test {
namespace {

using test::BoxBuilding;

class AccuracyTable : public ::testing::Test {
 protected:
  std::shared_ptr<test::WritingHost> host = std::make_shared<test::WritingHost>();
  Context context{1, host};
  Building building;
  Mesh mesh;
  Cloud cloud;

  /// One room of 4 m × 3 m × 2.5 m, far from the cloud's and the mesh's own zero.
  AccuracyTable() {
    BoxBuilding b;
    b.room(0, 0, 4, 3);
    building = b.building;
    building.faces[5].primitive = -1;
    mesh.origin = {1000, 0, 0};
    cloud.origin = {1000, 0, -2};
    mesh.vertices = building.vertices;
    for (std::size_t f = 0; f < building.faces.size(); ++f) {
      const auto& ring = building.faces[f].outline;
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        mesh.triangles.push_back({ring[0], ring[i], ring[i + 1]});
        mesh.primitives.push_back(static_cast<std::int32_t>(f));
      }
    }
  }
  void point(double x, double y, double z) { cloud.points.emplace_back(Eigen::Vector3d(x, y, z + 2).cast<float>()); }
  Metrics run(const Accuracy::Params& params = {}) {
    return Accuracy::run({input(building), input(mesh), input(cloud)}, params, context).metrics;
  }
  std::vector<std::string> lines() const {
    std::ifstream file(host->folder / "accuracy.csv");
    std::vector<std::string> result;
    for (std::string line; std::getline(file, line);) result.push_back(line.substr(0, line.find('\r')));
    return result;
  }
  static double value(const Metrics& metrics, const std::string& name) {
    for (const auto& m : metrics.values)
      if (m.name == name) return m.value;
    return std::nan("");
  }
};

TEST_F(AccuracyTable, DistancesHaveSignsAndBands) {
  // Of the wall y = 0, which is seen from y > 0: 95 points 3 mm before it, 5 points 20 mm behind it. Of the floor 20
  // points 10 mm above it. A table, 70 cm above the floor, is no face's.
  for (int i = 0; i < 100; ++i) point(0.5 + 0.03 * i, i < 95 ? 0.003 : -0.02, 1.2);
  for (int i = 0; i < 20; ++i) point(0.5 + 0.1 * i, 1, 0.01);
  for (int i = 0; i < 50; ++i) point(0.5 + 0.05 * i, 1.5, 0.7);
  for (int i = 0; i < 5; ++i) point(4.001, 1 + 0.1 * i, 1);
  const Metrics metrics = run();
  const auto table = lines();
  ASSERT_EQ(table.size(), 7U);
  EXPECT_EQ(table[0], "face,class,storey,room,area_m2,points,median_mm,rms_mm,p95_mm,covered,inferred,loa");
  EXPECT_EQ(table[1], "0,floor,0,room 1,12.000,20,10.00,10.00,10.00,0.900,no,LOA30");
  EXPECT_EQ(table[2], "1,ceiling,0,room 1,12.000,0,,,,0.900,no,");
  EXPECT_EQ(table[3], "2,wall,0,room 1,10.000,100,3.00,5.34,3.00,0.900,no,LOA40");
  EXPECT_EQ(table[4].substr(0, 40), "3,wall,0,room 1,7.500,5,-1.00,1.00,1.00,") << "too few for a band";
  EXPECT_EQ(table[6].substr(table[6].size() - 4), "yes,");
  EXPECT_EQ(value(metrics, "accuracy.all.points"), 125);
  EXPECT_EQ(value(metrics, "accuracy.wall.points"), 105);
  EXPECT_NEAR(value(metrics, "accuracy.floor.median"), 0.01, 1e-6);
  EXPECT_TRUE(std::isnan(value(metrics, "accuracy.ceiling.points")));
  const double area = 2 * 12 + 2 * 10 + 2 * 7.5;
  EXPECT_NEAR(value(metrics, "accuracy.area.loa30"), 12 / area, 1e-9);
  EXPECT_NEAR(value(metrics, "accuracy.area.loa40"), 10 / area, 1e-9);
  EXPECT_NEAR(value(metrics, "accuracy.area.unknown"), 1 - 22 / area, 1e-9);
}

TEST_F(AccuracyTable, SaysWhatMeetsTheBandThatIsAskedFor) {
  for (int i = 0; i < 30; ++i) point(0.5 + 0.1 * i, 0.002, 1);
  for (int i = 0; i < 30; ++i) point(0.5 + 0.1 * i, 1, 0.03);
  Accuracy::Params params;
  params.specified = Accuracy::Band::loa30;
  const Metrics metrics = run(params);
  const auto table = lines();
  EXPECT_EQ(table[1].substr(table[1].size() - 8), "LOA20,no");
  EXPECT_EQ(table[3].substr(table[3].size() - 9), "LOA40,yes");
  EXPECT_NEAR(value(metrics, "accuracy.area.meets"), 10.0 / 59, 1e-9);
}

TEST_F(AccuracyTable, SquaresOfALargeFaceAreWiderThanAskedFor) {
  for (auto& v : mesh.vertices) v.head<2>() *= 10;  // a floor of 40 m × 30 m: 12 million squares of a centimetre
  for (int i = 0; i < 20; ++i) point(5 + i, 7, 0.01);
  Accuracy::Params params;
  params.cell = 0.01;
  run(params);
  const auto json = nlohmann::json::parse(std::ifstream(host->folder / "heat_maps.json"));
  EXPECT_NEAR(json["cell"].get<double>(), std::sqrt(1200 / 1e6), 1e-6);
  ASSERT_EQ(json["faces"].size(), 1U);
  const auto& face = json["faces"][0];
  const std::size_t count = face["columns"].get<std::size_t>() * face["rows"].get<std::size_t>();
  EXPECT_LT(count, 1'010'000U);
  ASSERT_EQ(face["squares"].size(), count);
  EXPECT_EQ(std::count_if(face["squares"].begin(), face["squares"].end(), [](const auto& v) { return v == 100; }), 20);
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_EQ(host->warnings[0],
            "squares of 0.035 m instead of 0.010 m, so that no face has more than about 1000000 of them");
}

TEST_F(AccuracyTable, TheSquaresAreThereForProgramsWithTheirPlaces) {
  // Of the wall y = 0, seen from y > 0: 20 mm before it at x 0.5 … 1.5, 3 mm behind it at x 3; one point at its far
  // corner.
  for (int i = 0; i < 10; ++i) point(0.55 + 0.1 * i, 0.02, 1.05);
  point(3.05, -0.003, 0.05);
  point(3.95, 0.001, 2.45);
  run();
  const auto json = nlohmann::json::parse(std::ifstream(host->folder / "heat_maps.json"));
  EXPECT_EQ(json["atrium_heat_maps"], 1);
  EXPECT_EQ(json["cell"], 0.1);
  EXPECT_EQ(json["range"], 0.02);
  ASSERT_EQ(json["faces"].size(), 1U) << "faces without points are left out";
  const auto& face = json["faces"][0];
  EXPECT_EQ(face["face"], 2);
  const int columns = face["columns"], rows = face["rows"];
  EXPECT_EQ(columns, 40);
  EXPECT_EQ(rows, 25);
  ASSERT_EQ(face["squares"].size(), 1000U);
  std::map<std::string, int> found;  // by the place that the file says
  for (int i = 0; i < 1000; ++i) {
    if (face["squares"][i].is_null()) continue;
    Eigen::Vector3d at;
    for (int k = 0; k < 3; ++k)
      at[k] = json["origin"][k].get<double>() + face["corner"][k].get<double>() +
              0.1 * (i % columns + 0.5) * face["across"][k].get<double>() +
              0.1 * (i / columns + 0.5) * face["up"][k].get<double>();
    found[fmt::format("{:.2f} {:.2f} {:.2f}", at.x() - 1000, at.y(), at.z())] = face["squares"][i];
  }
  EXPECT_EQ(found.size(), 12U);
  EXPECT_EQ(found.at("0.55 0.00 1.05"), 200);
  EXPECT_EQ(found.at("1.45 0.00 1.05"), 200);
  EXPECT_EQ(found.at("3.05 0.00 0.05"), -30);
  EXPECT_EQ(found.at("3.95 0.00 2.45"), 10);
}

TEST_F(AccuracyTable, TheHeatMapShowsEachFaceAndItsSquares) {
  building.rooms[0].name = "a < b & c";
  for (int i = 0; i < 30; ++i) point(0.55 + 0.1 * i, 0.02, 1.05);
  run();
  std::ostringstream text;
  text << std::ifstream(host->folder / "accuracy.svg").rdbuf();
  const std::string svg = text.str();
  EXPECT_NE(svg.find("face 2 (wall), a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(svg.find("median +20.0 mm, 95 % 20.0 mm, LOA20"), std::string::npos);
  EXPECT_NE(svg.find("<path fill=\"#b40426\" d=\"M"), std::string::npos) << "the scale's red end";
  EXPECT_NE(svg.find("20 mm behind the face"), std::string::npos);
  const auto begin = svg.find("<path fill=\"#b40426\"");
  const std::string path = svg.substr(begin, svg.find("/>", begin) - begin);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'z'), 30);
}

TEST_F(AccuracyTable, OtherProgramsDrawTheHeatMap) {
  ATRIUM_SKIP_WITHOUT_SVG_READERS();
  building.rooms[0].name = "]]> a < b & \"c\" \x01 \u53A8 \uFFFF";
  for (int i = 0; i < 30; ++i) point(0.55 + 0.1 * i, 0.02, 1.05);
  run();
  const auto map = test::drawn(host->folder / "accuracy.svg");
  // 40 pixels a metre: 30 squares of 10 cm, and the scale's red end of 12 × 14.
  EXPECT_GE(map.count(0xB40426), 30U * 4 * 4 + 11 * 13);
  EXPECT_LE(map.count(0xB40426), 30U * 4 * 4 + 12 * 14);
  EXPECT_GT(map.ink(), 0.05);
}

TEST_F(AccuracyTable, WithoutPointsAllIsUnknown) {
  const Metrics metrics = run();
  EXPECT_EQ(value(metrics, "accuracy.area.unknown"), 1);
  EXPECT_EQ(host->warnings.size(), 1U);
  EXPECT_EQ(lines().size(), 7U);
}

TEST_F(AccuracyTable, UnsoundInputIsRefusedAndLeavesNoFile) {
  point(1, 1, 0);
  Mesh sound = mesh;
  mesh.primitives.clear();
  EXPECT_THROW(run(), Error);
  mesh = sound;
  mesh.primitives[0] = 6;
  EXPECT_THROW(run(), Error);
  mesh = sound;
  mesh.vertices[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(run(), Error);
  mesh = sound;
  cloud.points[0].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(run(), Error);
  EXPECT_TRUE(std::filesystem::is_empty(host->folder.path()));
}

}  // namespace
}  // namespace atrium::building::accuracy_test
