#include "modules/floorplan/write_geojson.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan::write_geojson_test {
namespace {

using nlohmann::json;

class Geojson : public testing::Test {
 protected:
  std::shared_ptr<Host> host = std::make_shared<Host>();
  Context context{1, host};

  json write(const FloorPlan& plan, const WriteGeojson::Params& params = {}) {
    WriteGeojson::run({input(plan)}, params, context);
    return json::parse(test::read_text(host->folder / "floorplan.geojson"));
  }
};

double signed_area(const json& ring) {
  double twice = 0;
  const double x0 = ring[0][0], y0 = ring[0][1];
  for (std::size_t i = 0; i + 1 < ring.size(); ++i)
    twice += (ring[i][0].get<double>() - x0) * (ring[i + 1][1].get<double>() - y0) -
             (ring[i + 1][0].get<double>() - x0) * (ring[i][1].get<double>() - y0);
  return 0.5 * twice;
}

Mesh with_hole(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  MeshBuilder b;
  b.floor(0, 0, 6, 2);
  b.floor(0, 4, 6, 6);
  b.floor(0, 2, 2, 4);
  b.floor(4, 2, 6, 4);
  b.wall(0, 0, 6, 0);
  b.wall(6, -0.2, 3, -0.2);
  b.ceiling(0, 0, 6, 6, 2.5);
  b.mesh.origin = origin;
  return b.mesh;
}

TEST_F(Geojson, RingsAreClosedAndWoundAsTheStandardSays) {
  const json root = write(plan_of(with_hole()));
  EXPECT_EQ(root["type"], "FeatureCollection");
  std::size_t holes = 0;
  for (const auto& feature : root["features"]) {
    EXPECT_EQ(feature["type"], "Feature");
    if (feature["geometry"]["type"] != "Polygon") continue;
    const auto& rings = feature["geometry"]["coordinates"];
    double area = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      EXPECT_GE(rings[i].size(), 4U);
      EXPECT_EQ(rings[i].front(), rings[i].back());
      EXPECT_EQ(signed_area(rings[i]) > 0, i == 0);
      area += signed_area(rings[i]);
      holes += i;
    }
    EXPECT_NEAR(area, feature["properties"].value("area_m2", area), 0.01);
  }
  EXPECT_GT(holes, 0U);
}

TEST_F(Geojson, OpeningsTellWhatTheyJoin) {
  std::map<std::string, std::vector<json>> openings;
  const json root = write(with_openings());
  for (const auto& feature : root["features"])
    if (const std::string kind = feature["properties"]["class"]; kind == "door" || kind == "window" || kind == "slab")
      openings[kind].push_back(feature);
  ASSERT_EQ(openings["door"].size(), 1U);
  const json& door = openings["door"][0];
  EXPECT_EQ(door["properties"]["rooms"], json::array({"Room 1", "Room 2"}));
  EXPECT_EQ(door["properties"]["width_m"], 0.9);
  EXPECT_EQ(door["properties"]["height_m"], 2.1);
  EXPECT_EQ(door["properties"]["thickness_m"], 0.12);
  EXPECT_NEAR(signed_area(door["geometry"]["coordinates"][0]), 0.9 * 0.12, 1e-6);
  ASSERT_EQ(openings["window"].size(), 1U);
  const json& window = openings["window"][0];
  EXPECT_EQ(window["geometry"]["type"], "LineString");
  EXPECT_EQ(window["properties"]["rooms"], json::array({"Room 1", nullptr}));
  EXPECT_EQ(window["properties"]["sill_m"], 0.9);
  EXPECT_TRUE(window["properties"]["thickness_m"].is_null());
  ASSERT_EQ(openings["slab"].size(), 2U);
  EXPECT_EQ(openings["slab"][1]["properties"]["sill_m"], 2.5);
}

TEST_F(Geojson, FeaturesTellWhatTheyAre) {
  const json root = write(plan_of(with_hole()));
  int polygons = 0, lines = 0, floors = 0, ceilings = 0, rooms = 0;
  for (const auto& feature : root["features"]) {
    const auto& p = feature["properties"];
    EXPECT_EQ(p["storey"], 0);
    if (p["class"] == "wall" && feature["geometry"]["type"] == "Polygon") {
      ++polygons;
      EXPECT_NEAR(p["thickness_m"], 0.2, 1e-4);
      EXPECT_NEAR(p["length_m"], 3, 1e-4);
    } else if (p["class"] == "wall") {
      ++lines;
      EXPECT_TRUE(p["thickness_m"].is_null());
    } else if (p["class"] == "floor") {
      ++floors;
      EXPECT_NEAR(p["area_m2"], 32, 1e-3);
    } else if (p["class"] == "ceiling") {
      ++ceilings;
    } else if (p["class"] == "room") {
      ++rooms;
      EXPECT_EQ(p["name"], "Room 1");
      EXPECT_NEAR(p["height_m"], 2.5, 1e-4);
    }
  }
  EXPECT_EQ(polygons, 1);
  EXPECT_EQ(lines, 1);
  EXPECT_EQ(floors, 1);
  EXPECT_EQ(ceilings, 1);
  EXPECT_EQ(rooms, 1);
}

TEST_F(Geojson, CoordinatesKeepTheirOffsetsToTheMillimetre) {
  const json root = write(plan_of(with_hole({500000.123, 5400000.456, 300.5})));
  bool found = false;
  for (const auto& feature : root["features"])
    if (feature["properties"]["class"] == "floor")
      for (const auto& corner : feature["geometry"]["coordinates"][0])
        found = found || (std::abs(corner[0].get<double>() - 500000.123) < 2e-4 &&
                          std::abs(corner[1].get<double>() - 5400000.456) < 2e-4);
  EXPECT_TRUE(found);
}

TEST_F(Geojson, RoomsHaveTheCornersOfTheirFaces) {
  MeshBuilder b;
  b.room(0, 0, 5, 4, 0, 2.6);
  const json room = write(plan_of(b.mesh))["features"][0];
  EXPECT_EQ(room["properties"]["area_m2"], 20.0);
  EXPECT_EQ(room["geometry"]["coordinates"],
            json::parse("[[[0.0, 0.0], [5.0, 0.0], [5.0, 4.0], [0.0, 4.0], [0.0, 0.0]]]"));
}

TEST_F(Geojson, WhatIsNotKnownIsNull) {
  MeshBuilder only_ceiling, upside_down;
  only_ceiling.ceiling(0, 0, 5, 4, 2.6);
  upside_down.room(0, 0, 5, 4, 0, -2.6);
  const json floorless = write(plan_of(only_ceiling.mesh))["features"][0]["properties"];
  EXPECT_TRUE(floorless["height_m"].is_null());
  EXPECT_TRUE(floorless["elevation_m"].is_null());
  const json upside = write(plan_of(upside_down.mesh))["features"][0]["properties"];
  EXPECT_TRUE(upside["height_m"].is_null());
  EXPECT_EQ(upside["elevation_m"], 0.0);
}

TEST_F(Geojson, TheReferenceSystemIsNamedWhereItIsKnown) {
  const FloorPlan plan = plan_of(two_rooms());
  EXPECT_FALSE(write(plan).contains("crs"));
  WriteGeojson::Params params;
  params.crs = "EPSG:25832";
  json root = write(plan, params);
  EXPECT_EQ(root["crs"]["type"], "name");
  EXPECT_EQ(root["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::25832");
  EXPECT_EQ(root["frame"], "metres in EPSG:25832: easting, northing");
  const auto of_scan = [&](const std::string& crs, const FloorPlan& drawn) {
    Cloud scan;
    scan.crs = crs;
    WriteGeojson::run({input(drawn), input(scan)}, {}, context);
    return json::parse(test::read_text(host->folder / "floorplan.geojson"));
  };
  EXPECT_EQ(of_scan("EPSG:32633", plan)["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::32633");
  root = of_scan("PROJCRS[\"local grid\",BASEGEOGCRS[\"x\"]]", plan);
  EXPECT_FALSE(root.contains("crs")) << "it has no code";
  EXPECT_EQ(root["frame"], "metres in local grid: easting, northing");
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_NE(host->warnings[0].find("'local grid' is in the member frame only"), std::string::npos);
  FloorPlan lying = plan;  // of a scan whose y is up
  lying.to_plan.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  EXPECT_FALSE(of_scan("EPSG:32633", lying).contains("crs"));
  EXPECT_EQ(host->warnings.size(), 2U);
  params.crs = "UTM 32";
  EXPECT_THROW(write(plan, params), Error);
}

TEST_F(Geojson, AnEmptyPlanIsAnEmptyCollection) {
  EXPECT_TRUE(write({})["features"].empty());
  EXPECT_EQ(host->warnings.size(), 1U);
}

TEST_F(Geojson, AFolderThatCannotBeWrittenIsAnError) {
  test::write_text(host->folder / "file", "");
  WriteGeojson::Params params;
  params.path.path = "file/plan.geojson";
  EXPECT_THROW(write(plan_of(two_rooms()), params), Error);
}

}  // namespace
}  // namespace atrium::floorplan::write_geojson_test
