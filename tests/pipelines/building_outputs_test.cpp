// What pipelines/atrium.yaml writes of a simulated flat, and what can be made of its files.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "tests/pipelines/steps.hpp"
#include "tests/support/lacking.hpp"
#include "tests/support/svg_drawing.hpp"

namespace atrium::test::building_outputs_test {
namespace {

using nlohmann::json;

// Rooms of synth.flat with its default sizes (10.2 m × 8 m, walls of 12 cm): the largest first.
const double xs = 0.56 * 10.2, left = 0.58 * 8, right = 0.47 * 8, t = 0.12;
const std::vector<double> flat_rooms{xs * left, xs*(8 - left - t), (10.2 - xs - t) * (8 - right - t),
                                     (10.2 - xs - t) * right};

class BuildingOutputs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<TemporaryFolder>();
    const auto simulated = run_pipeline_file(
        "simulate.yaml", {"points=400000", "noise=8 mm", "yaw=23 deg", "tilt=2.5 deg", "offset=[500000, 5400000, 300]"},
        *scratch / "scan");
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    const auto made = run_pipeline_file("atrium.yaml",
                                        {"scan=" + (*scratch / "scan/scan.ply").string(), "crs=EPSG:25832",
                                         "objects.type=object.poisson", "objects.depth=6"},
                                        *scratch / "made");
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() { scratch.reset(); }
  static json building() { return json::parse(read_text(*scratch / "made/building.json")); }
  static std::string made(const std::string& name) { return *scratch / "made" / name; }
  /// Where validators that npm fetches are kept.
  static std::string kept(const std::string& name) {
    return fs::path(ATRIUM_PROGRAM).parent_path().parent_path() / "tests" / name;
  }
  // Each skips the test for want of a program.
  static void expect_valid_scene();
  static void expect_valid_plans();
  static void expect_valid_drawings();
  static void expect_valid_json();
  static std::unique_ptr<TemporaryFolder> scratch;
};
std::unique_ptr<TemporaryFolder> BuildingOutputs::scratch;

void expect_areas(std::vector<double> areas) {
  std::sort(areas.rbegin(), areas.rend());
  ASSERT_EQ(areas.size(), flat_rooms.size());
  for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], flat_rooms[i], 0.02 * flat_rooms[i]);
}

TEST_F(BuildingOutputs, TheBuildingHasTheRoomsInTheInputsFrame) {
  const json root = building();
  std::vector<double> areas;
  for (const auto& room : root["rooms"]) areas.push_back(room["area"]);
  expect_areas(areas);
  EXPECT_NEAR(root["origin"][0], 500000, 30);
  EXPECT_NEAR(root["origin"][1], 5400000, 30);
  EXPECT_LT(root["up"][2], 0.9995) << "the scan is tilted by 2.5°";
  EXPECT_GT(root["up"][2], 0.998);
  EXPECT_FALSE(root["openings"].empty());
}

TEST_F(BuildingOutputs, ThePlanHasTheRoomsAndTheDoorsBetweenThem) {
  const json plan = json::parse(read_text(*scratch / "made/floorplan.geojson"));
  std::vector<double> areas;
  std::size_t inner_doors = 0;
  for (const auto& feature : plan["features"]) {
    const json& properties = feature["properties"];
    if (properties["class"] == "room") areas.push_back(properties["area_m2"]);
    if (properties["class"] == "door" && properties["rooms"][0].is_string() && properties["rooms"][1].is_string()) {
      ++inner_doors;
      EXPECT_NEAR(properties["thickness_m"], 0.12, 0.02);
    }
  }
  expect_areas(areas);
  EXPECT_GE(inner_doors, 2U);
}

TEST_F(BuildingOutputs, TheSceneAndItsModelAreThere) {
  for (const auto* name : {"structure.ply", "shell.ply", "scene.ply", "scene_without_ceiling.ply", "scene.glb",
                           "scan.glb", "floorplan.svg", "floorplan.pdf", "floorplan.dxf", "building.ifc",
                           "building.city.json", "accuracy.csv", "accuracy.svg", "walls.csv"})
    EXPECT_GT(fs::file_size(*scratch / "made" / name), 1000U) << name;
}

void BuildingOutputs::expect_valid_scene() {
  const auto result = run_validator("validate-glb", {kept("gltf-validator"), made("scene.glb")});
  if (result.exit_code == 77) ATRIUM_SKIP_LACKING("the glTF validator cannot be had: " << result.err);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_EQ(report["issues"]["numErrors"], 0) << report["issues"];
  EXPECT_EQ(report["issues"]["numWarnings"], 0) << report["issues"];
  for (const auto& message : report["issues"]["messages"])
    EXPECT_EQ(message["code"], "IMAGE_NPOT_DIMENSIONS") << message;  // of no concern since WebGL 2
  EXPECT_TRUE(report["info"]["hasTextures"]);
  EXPECT_GT(report["info"]["totalTriangleCount"], 1000) << "the furniture";
}

void BuildingOutputs::expect_valid_plans() {
  const auto geojson = run_validator("validate-geojson", {made("floorplan.geojson")});
  EXPECT_EQ(geojson.out, made("floorplan.geojson") + ": $: has the member 'crs' (§4, B.1)\n") << geojson.err;
  const auto city = run_validator("validate-cityjson", {made("building.city.json")});
  EXPECT_EQ(city.exit_code, 0) << city.err;
  EXPECT_EQ(city.out, "");
  const std::string python = python_with("ezdxf");
  if (python.empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  const auto dxf = run_process({python, ATRIUM_SOURCE_DIR "/tests/unit/floorplan/read_dxf.py", made("floorplan.dxf")});
  ASSERT_EQ(dxf.exit_code, 0) << dxf.err;
  const json root = json::parse(dxf.out);
  for (const auto* complaint : {"errors", "fixes", "logged", "structure"})
    EXPECT_EQ(root[complaint], json::array()) << complaint;
}

void BuildingOutputs::expect_valid_drawings() {
  ATRIUM_SKIP_WITHOUT_SVG_READERS();
  EXPECT_GT(drawn(made("floorplan.svg")).ink(), 0.05);
  const SvgDrawing map = drawn(made("accuracy.svg"));
  EXPECT_GT(map.ink(), 0.2);
  EXPECT_GT(map.count(0xF4F4F4), 1000U) << "faces where no point is";
  EXPECT_GT(map.count(0xDDDDDD), 1000U) << "squares without a deviation";
}

void BuildingOutputs::expect_valid_json() {
  for (const auto& [schema, file] :
       std::vector<std::pair<std::string, fs::path>>{{"building", made("building.json")},
                                                     {"manifest", made("manifest.json")},
                                                     {"trace", made("trace.json")},
                                                     {"pipeline", made("resolved.yaml")},
                                                     {"truth", *scratch / "scan/truth.json"}}) {
    const auto result = run_validator("validate-json", {source / "share/schema" / (schema + ".schema.json"), file});
    if (result.exit_code == 77) ATRIUM_SKIP_LACKING(result.err);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

// One test of them all, because each test makes the scan and the building anew. Where a program is lacking, what
// follows is checked all the same.
TEST_F(BuildingOutputs, OtherProgramsHaveNothingAgainstTheFiles) {
  expect_valid_scene();
  expect_valid_plans();
  expect_valid_drawings();
  expect_valid_json();
}

TEST_F(BuildingOutputs, AnotherProgramFindsTheBuildingInTheIfcFile) {
  const auto result = run_validator("validate-ifc", {kept("web-ifc"), made("building.ifc")});
  if (result.exit_code == 77) ATRIUM_SKIP_LACKING("web-ifc cannot be had: " << result.err);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(result.out), root = building();
  EXPECT_TRUE(report["log"].empty()) << report["log"];
  const auto openings = [&](const char* kind) {
    return std::count_if(root["openings"].begin(), root["openings"].end(),
                         [&](const json& opening) { return opening["kind"] == kind; });
  };
  EXPECT_EQ(report["counts"]["IFCBUILDINGSTOREY"], root["storeys"].size());
  EXPECT_EQ(report["counts"]["IFCSPACE"], root["rooms"].size());
  EXPECT_EQ(report["counts"]["IFCDOOR"], openings("door"));
  EXPECT_EQ(report["counts"]["IFCWINDOW"], openings("window"));
  EXPECT_EQ(report["counts"]["IFCOPENINGELEMENT"], root["openings"].size());
  std::size_t space = 0, walls = 0;
  for (const auto& element : report["elements"]) {
    const double volume = element["volume"];
    if (element["type"] == "IFCSPACE") {
      EXPECT_NEAR(volume, root["rooms"][space++]["volume"], 0.005 * volume);
    }
    if (element["type"] != "IFCWALL") continue;
    EXPECT_NEAR(volume, element["stated"].get<double>(), 0.005 * volume) << element["name"];
    ++walls;
  }
  EXPECT_GE(walls, root["walls"].size());
}

TEST_F(BuildingOutputs, TheCityModelHasTheRoomsAndTheirOpenings) {
  const json city = json::parse(read_text(*scratch / "made/building.city.json")), root = building();
  EXPECT_EQ(city["CityObjects"].size(), 1 + root["storeys"].size() + root["rooms"].size());
  std::map<std::string, std::size_t> surfaces;
  for (std::size_t r = 0; r < root["rooms"].size(); ++r) {
    const json& room = city["CityObjects"]["room-" + std::to_string(r)];
    EXPECT_EQ(room["attributes"]["name"], root["rooms"][r]["name"]);
    ASSERT_EQ(room["geometry"][0]["type"], "Solid") << r;
    for (const auto& surface : room["geometry"][0]["semantics"]["surfaces"]) ++surfaces[surface["type"]];
  }
  std::size_t doors = 0, windows = 0;
  for (const auto& opening : root["openings"]) {
    const std::size_t sides = (opening["face_a"] >= 0 ? 1U : 0U) + (opening["face_b"] >= 0 ? 1U : 0U);
    if (opening["kind"] == "door") doors += sides;
    if (opening["kind"] == "window") windows += sides;
  }
  EXPECT_EQ(surfaces["Door"], doors);
  EXPECT_EQ(surfaces["Window"], windows);
  EXPECT_GT(doors, 4U);
  EXPECT_NEAR(city["metadata"]["geographicalExtent"][0], 500000, 30);
  EXPECT_NEAR(city["metadata"]["geographicalExtent"][1], 5400000, 30);
}

TEST_F(BuildingOutputs, TheReferenceSystemIsInAllFilesThatCanNameIt) {
  EXPECT_NE(read_text(*scratch / "made/building.ifc").find("IFCPROJECTEDCRS('EPSG:25832'"), std::string::npos);
  EXPECT_NE(read_text(*scratch / "made/floorplan.dxf").find("coordinates: EPSG:25832"), std::string::npos);
  EXPECT_NE(read_text(*scratch / "made/scene.glb").find("\"crs\":\"EPSG:25832\""), std::string::npos);
  const json plan = json::parse(read_text(*scratch / "made/floorplan.geojson"));
  EXPECT_EQ(plan["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::25832");
  const json city = json::parse(read_text(*scratch / "made/building.city.json"));
  EXPECT_EQ(city["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/25832");
  const auto wrong = run_pipeline_file("atrium.yaml", {"scan=" + (*scratch / "scan/scan.ply").string(), "crs=UTM 32"},
                                       *scratch / "wrong");
  EXPECT_NE(wrong.exit_code, 0);
  EXPECT_NE(wrong.err.find("'UTM 32' names no coordinate reference system"), std::string::npos) << wrong.err;
}

TEST_F(BuildingOutputs, TheFileGivesTheSameMeshAndPlan) {
  std::ofstream(*scratch / "again.yaml")
      << "atrium: 1\n"
         "nodes:\n"
         "  read: {type: io.read_building, params: {path: made/building.json}}\n"
         "  mesh: {type: layout.mesh, in: {building: read.building, transform: read.transform}}\n"
         "  write: {type: io.write_mesh, in: {mesh: mesh.shell}, params: {path: shell.ply}}\n"
         "  plan: {type: floorplan.from_building, in: {building: read.building, transform: read.transform}}\n"
         "  draw: {type: floorplan.write_geojson, in: {plan: plan.plan}, params: {path: floorplan.geojson}}\n"
         "  back: {type: io.write_building, in: {building: read.building, transform: read.transform}, params: {path: "
         "building.json}}\n";
  const auto again =
      atrium({"run", (*scratch / "again.yaml").string(), "--quiet", "--out", (*scratch / "again").string()});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(fs::file_size(*scratch / "again/shell.ply"), fs::file_size(*scratch / "made/shell.ply"));
  // Through the turn and back, nothing moves by more than a hundredth of a millimetre.
  const json first = building(), second = json::parse(read_text(*scratch / "again/building.json"));
  ASSERT_EQ(first["vertices"].size(), second["vertices"].size());
  for (std::size_t i = 0; i < first["vertices"].size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(first["vertices"][i][k].get<double>() + first["origin"][k].get<double>(),
                  second["vertices"][i][k].get<double>() + second["origin"][k].get<double>(), 1e-5);
  EXPECT_EQ(json::parse(read_text(*scratch / "again/floorplan.geojson"))["features"].size(),
            json::parse(read_text(*scratch / "made/floorplan.geojson"))["features"].size());
}

}  // namespace
}  // namespace atrium::test::building_outputs_test
