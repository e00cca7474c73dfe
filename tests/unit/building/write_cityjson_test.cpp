#include "modules/building/write_cityjson.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "houses.hpp"
#include "tests/support/lacking.hpp"
#include "writing_host.hpp"

namespace atrium::building::write_cityjson_test {
namespace {

using nlohmann::json;
using test::BoxBuilding;
using test::House;

class CityJson : public ::testing::Test {
 protected:
  std::shared_ptr<test::WritingHost> host = std::make_shared<test::WritingHost>();
  Context context{1, host};

  std::string file() const { return host->folder / "building.city.json"; }
  /// The file; what tests/validate-cityjson has against it is a failure.
  json write(const Building& building, const WriteCityjson::Params& params = {}, WriteCityjson::In more = {}) {
    more.building = input(building);
    WriteCityjson::run(more, params, context);
    const auto result = test::run_validator("validate-cityjson", {file()});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    return json::parse(test::read_text(file()));
  }
};

const json& geometry_of(const json& root, const std::string& object) {
  return root["CityObjects"][object]["geometry"].at(0);
}

/// How many polygons are of surfaces of a type.
std::size_t count(const json& geometry, const std::string& type) {
  std::size_t count = 0;
  for (const auto& value : geometry["semantics"]["values"].at(0))
    if (geometry["semantics"]["surfaces"].at(value.get<std::size_t>())["type"] == type) ++count;
  return count;
}

Eigen::Vector3d place(const json& root, const json& index) {
  const auto& vertex = root["vertices"].at(index.get<std::size_t>());
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i)
    result[i] = vertex[static_cast<std::size_t>(i)].get<double>() *
                    root["transform"]["scale"][static_cast<std::size_t>(i)].get<double>() +
                root["transform"]["translate"][static_cast<std::size_t>(i)].get<double>();
  return result;
}

double volume_of(const json& root, const json& geometry) {
  const auto& shell = geometry["boundaries"].at(0);
  const Eigen::Vector3d first = place(root, shell.at(0).at(0).at(0));
  double volume = 0;
  for (const auto& polygon : shell)
    for (const auto& ring : polygon)
      for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        volume +=
            (place(root, ring[0]) - first).dot((place(root, ring[i]) - first).cross(place(root, ring[i + 1]) - first)) /
            6;
  return volume;
}

Building three_rooms_high() {
  BoxBuilding b;
  b.building.storeys = {{0, 2.5}, {2.8, 2.5}};
  b.room(0, 0, 4, 3);
  b.room(0, 0, 4, 3, 2.8, 5.3, 1);
  b.room(4.12, 0, 7, 3, 2.8, 5.3, 1);
  BuildingOpening hole{"slab", 0, 1, 1, 6, 0.3, {}, {}};
  hole.outline_a = {{1, 1, 2.5}, {1, 2, 2.5}, {2, 2, 2.5}, {2, 1, 2.5}};
  hole.outline_b = {{1, 1, 2.8}, {2, 1, 2.8}, {2, 2, 2.8}, {1, 2, 2.8}};
  BuildingOpening passage{"passage", 1, 2, 9, 17, 0.12, {}, {}};
  passage.outline_a = {{4, 0, 2.8}, {4, 0, 5.3}, {4, 3, 5.3}, {4, 3, 2.8}};  // all of the wall
  b.building.openings = {hole, passage};
  return b.building;
}

TEST_F(CityJson, RoomsAreSolidsWithTheirOpenings) {
  const json root = write(BoxBuilding::two_rooms());
  EXPECT_EQ(root["type"], "CityJSON");
  EXPECT_EQ(root["version"], "2.0");
  EXPECT_EQ(root["metadata"]["geographicalExtent"], json({0.0, 0.0, 0.0, 7.0, 3.0, 2.5}));
  EXPECT_FALSE(root["metadata"].contains("referenceSystem"));
  const json& objects = root["CityObjects"];
  ASSERT_EQ(objects.size(), 4U);
  EXPECT_EQ(objects["building"]["children"], json({"storey-0"}));
  EXPECT_EQ(objects["storey-0"]["children"], json({"room-0", "room-1"}));
  EXPECT_EQ(objects["room-1"]["parents"], json({"storey-0"}));
  EXPECT_EQ(objects["room-0"]["attributes"]["name"], "room 1");
  EXPECT_EQ(objects["room-0"]["attributes"]["volume_m3"], 30.0);
  const json& first = geometry_of(root, "room-0");
  EXPECT_EQ(first["type"], "Solid");
  EXPECT_NEAR(volume_of(root, first), 30, 1e-6) << "positive: seen from outside";
  EXPECT_EQ(count(first, "InteriorWallSurface"), 4U);
  EXPECT_EQ(count(first, "FloorSurface"), 1U);
  EXPECT_EQ(count(first, "CeilingSurface"), 1U);
  EXPECT_EQ(count(first, "Door"), 1U);
  EXPECT_EQ(count(first, "Window"), 1U);
  EXPECT_EQ(count(geometry_of(root, "room-1"), "Door"), 1U);
  EXPECT_EQ(count(geometry_of(root, "room-1"), "Window"), 0U);
  // The door stands on the floor's edge, whose polygon has its corners too; the window is a hole in its wall.
  std::size_t floor_corners = 0, holes = 0;
  for (std::size_t i = 0; i < first["boundaries"][0].size(); ++i) {
    const auto& surface = first["semantics"]["surfaces"].at(first["semantics"]["values"][0][i].get<std::size_t>());
    if (surface["type"] == "FloorSurface") floor_corners = first["boundaries"][0][i][0].size();
    holes += first["boundaries"][0][i].size() - 1;
    if (surface["type"] == "Door") {
      EXPECT_EQ(surface["opening"], 0);
      EXPECT_EQ(first["semantics"]["surfaces"].at(surface["parent"].get<std::size_t>())["face"], 3);
    }
  }
  EXPECT_EQ(floor_corners, 6U);
  EXPECT_EQ(holes, 1U);
  EXPECT_TRUE(host->warnings.empty());
}

TEST_F(CityJson, PassagesAndHolesInSlabsAreClosureSurfaces) {
  const json root = write(three_rooms_high());
  EXPECT_EQ(root["CityObjects"]["building"]["children"], json({"storey-0", "storey-1"}));
  EXPECT_EQ(root["CityObjects"]["storey-1"]["attributes"]["elevation_m"], 2.8);
  EXPECT_EQ(count(geometry_of(root, "room-0"), "ClosureSurface"), 1U);
  const json& upper = geometry_of(root, "room-1");
  EXPECT_EQ(count(upper, "ClosureSurface"), 2U);
  EXPECT_EQ(count(upper, "InteriorWallSurface"), 3U) << "of the fourth wall nothing is left";
  EXPECT_NEAR(volume_of(root, upper), 30, 1e-6);
}

TEST_F(CityJson, RoomsOfAnyShapeClose) {
  House house;
  house.building.storeys = {{0, 2.5}};
  House::Plan plan;
  plan.plan = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  plan.extra = {{0, 2}, {6, 2}};
  plan.ceilings = {{0, 1, 5, 4}, {4, 5, 2, 3}};
  plan.peaks = {{}, {5}, {}, {4}};
  house.room(plan, 0, [](double, double y) { return 2 + std::min(y, 4 - y); });
  const json root = write(house.building);
  const json& attic = geometry_of(root, "room-0");
  EXPECT_EQ(count(attic, "CeilingSurface"), 2U);
  EXPECT_NEAR(volume_of(root, attic), 6 * 4 * 3, 1e-3);
}

TEST_F(CityJson, StandsWhereTheScanWasAndNamesItsSystem) {
  Building building = BoxBuilding::two_rooms();
  building.origin = {500000.25, 5400000.5, 300};
  Cloud scan;
  scan.crs = "PROJCS[\"x\",AUTHORITY[\"EPSG\",\"32633\"]]";
  WriteCityjson::In in;
  in.scan = input(scan);
  json root = write(building, {}, in);
  EXPECT_EQ(root["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/32633");
  EXPECT_NEAR(root["metadata"]["geographicalExtent"][0], 500000.25, 1e-4);
  EXPECT_NEAR(root["metadata"]["geographicalExtent"][4], 5400003.5, 1e-4);
  EXPECT_NEAR(root["CityObjects"]["storey-0"]["attributes"]["elevation_m"], 300, 1e-4);
  for (const auto& vertex : root["vertices"])
    for (const auto& number : vertex) EXPECT_LT(std::abs(number.get<std::int64_t>()), 1000000);
  WriteCityjson::Params params;
  params.crs = "EPSG:25832";
  root = write(building, params, in);
  EXPECT_EQ(root["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/25832");
  scan.crs = "PROJCRS[\"local grid\",BASEGEOGCRS[\"x\"]]";
  in.scan = input(scan);
  EXPECT_FALSE(write(building, {}, in)["metadata"].contains("referenceSystem"));
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_NE(host->warnings[0].find("'local grid' is not written"), std::string::npos);
}

TEST_F(CityJson, IsUprightWhereTheInputIsNot) {
  Transform lying;  // from the input's frame, in which y is up
  lying.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  WriteCityjson::In in;
  in.transform = input(lying);
  const json root = write(BoxBuilding::two_rooms(), {}, in);
  const auto extent = root["metadata"]["geographicalExtent"];
  EXPECT_NEAR(extent[5].get<double>() - extent[2].get<double>(), 2.5, 1e-3);
  EXPECT_TRUE(host->warnings.empty());
  WriteCityjson::Params params;
  params.crs = "EPSG:25832";
  EXPECT_FALSE(write(BoxBuilding::two_rooms(), params, in)["metadata"].contains("referenceSystem"));
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_TRUE(host->warnings[0].starts_with("the building is turned upright, out of EPSG:25832"));
}

TEST_F(CityJson, WhatDoesNotCloseIsSaid) {
  Building open = BoxBuilding::two_rooms();
  open.rooms[1].faces.pop_back();
  const json root = write(open);
  EXPECT_EQ(geometry_of(root, "room-0")["type"], "Solid");
  EXPECT_EQ(geometry_of(root, "room-1")["type"], "MultiSurface");
  EXPECT_EQ(host->warnings,
            std::vector<std::string>{"the surface of 'room 2' does not close: it is no solid, and has no openings"});
  for (const auto& surface : geometry_of(root, "room-1")["semantics"]["surfaces"])
    EXPECT_NE(surface["type"], "Door") << "the solid of room 1 has it";
}

TEST_F(CityJson, EqualBuildingsGiveEqualBytes) {
  write(three_rooms_high());
  const std::string text = test::read_text(file());
  write(three_rooms_high());
  EXPECT_EQ(test::read_text(file()), text);
}

TEST_F(CityJson, AnEmptyBuildingIsAFileWithoutRooms) {
  const json root = write(Building{});
  EXPECT_EQ(root["CityObjects"].size(), 1U);
  EXPECT_EQ(root["vertices"], json::array());
  EXPECT_EQ(host->warnings.size(), 1U);
}

TEST_F(CityJson, WhatIsWrongLeavesNoFile) {
  WriteCityjson::Params params;
  params.crs = "somewhere";
  EXPECT_THROW(WriteCityjson::run({input(BoxBuilding::two_rooms()), {}, {}}, params, context), Error);
  Building broken = BoxBuilding::two_rooms();
  broken.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteCityjson::run({input(broken), {}, {}}, {}, context), Error);
  EXPECT_TRUE(std::filesystem::is_empty(host->folder.path()));
}

// The rules of tests/validate-cityjson: each is named where it is broken, in a file that is sound else.
TEST_F(CityJson, EachRuleThatIsBrokenIsNamed) {
  const json sound = write(BoxBuilding::two_rooms());
  const std::string room = "/CityObjects/room-0", geometry = room + "/geometry/0", solid = geometry + "/boundaries/0",
                    semantics = geometry + "/semantics";
  json reversed = sound.at(json::json_pointer(solid));
  for (auto& polygon : reversed)
    for (auto& ring : polygon) std::reverse(ring.begin(), ring.end());
  json open = sound.at(json::json_pointer(solid)), values = sound.at(json::json_pointer(semantics + "/values/0"));
  open.erase(open.size() - 1);
  json all_but_one = values;
  all_but_one.erase(all_but_one.size() - 1);
  struct Case {
    std::string member;
    json value;
    std::string rule;
  };
  const std::vector<Case> cases{
      {"/type", "cityjson", "is not 'CityJSON'"},
      {"/version", "2.0.1", "is not '2.0'"},
      {"/comment", "x", "the member 'comment' is none of CityJSON"},
      {"/transform/scale", json({0, 1, 1}), "is not above zero"},
      {"/transform/translate", json({0, 1}), "is not three numbers"},
      {"/vertices/0", json({0.5, 0, 0}), "is not three whole numbers"},
      {"/vertices/0", sound["vertices"][1], "duplicate_vertices"},
      {"/vertices/" + std::to_string(sound["vertices"].size()), json({1, 2, 3}), "unused_vertices"},
      {room + "/type", "Room", "type is 'Room'"},
      {room + "/parents", json::array(), "has to have a parent"},
      {room + "/parents", json({"storey-1"}), "which is not there"},
      {room + "/parents", json({"building"}), "whose children do not name it"},
      {"/CityObjects/building/parents", json({"storey-0"}), "has no parents"},
      {room + "/colour", "red", "the member 'colour' is none of a City Object"},
      {geometry + "/lod", 3, "lod is no level"},
      {geometry + "/type", "Sphere", "is none of"},
      {solid + "/0/0/0", 10000, "wrong_vertex_index"},
      {solid + "/0/0", json({0, 1}), "fewer than three corners"},
      {solid + "/0/0", json({0, 0, 1, 2}), "twice in a row"},
      {solid, reversed, "turned the wrong way"},
      {solid, open, "semantics_array"},
      {semantics + "/values/0/0", 10000, "name a surface that is not there"},
      {semantics + "/surfaces/0/type", "Wall", "of no type of a building's surface"},
      {semantics + "/surfaces/0/parent", 1, "does not name it"},
      {"/metadata/referenceSystem", "EPSG:25832", "is no address"},
      {"/metadata/geographicalExtent/3", 8, "is not that of the vertices"}};
  std::vector<std::string> files;
  const auto add = [&](const json& root) {
    files.push_back(host->folder / fmt::format("{:02}.json", files.size()));
    test::write_text(files.back(), root.dump());
  };
  for (const auto& [member, value, rule] : cases) {
    json root = sound;
    root[json::json_pointer(member)] = value;
    add(root);
  }
  json root = sound;
  root[json::json_pointer(solid)] = open;
  root[json::json_pointer(semantics + "/values/0")] = all_but_one;
  add(root);
  add(sound);
  const auto result = test::run_validator("validate-cityjson", files);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "");
  const auto complaints = [&](std::size_t i) {
    std::string found;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(files[i] + ": ")) found += line + "\n";
    return found;
  };
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_NE(complaints(i).find(cases[i].rule), std::string::npos) << cases[i].member << ": " << complaints(i);
  EXPECT_NE(complaints(cases.size()).find("is not closed"), std::string::npos) << complaints(cases.size());
  EXPECT_EQ(complaints(cases.size() + 1), "");
}

}  // namespace
}  // namespace atrium::building::write_cityjson_test
