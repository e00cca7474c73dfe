#include "modules/building/write_ifc.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>

#include "houses.hpp"
#include "modules/building/step_reader.hpp"
#include "tests/support/lacking.hpp"
#include "writing_host.hpp"

namespace atrium::building::write_ifc_test {
namespace {

using nlohmann::json;
using test::BoxBuilding;
using test::House;

class IfcFile : public ::testing::Test {
 protected:
  std::shared_ptr<test::WritingHost> host = std::make_shared<test::WritingHost>();
  Context context{1, host};

  std::string text(const Building& building, WriteIfc::Params params = {}, WriteIfc::In more = {}) {
    more.building = input(building);
    WriteIfc::run(more, params, context);
    std::ostringstream result;
    result << std::ifstream(host->folder / params.path.path).rdbuf();
    return result.str();
  }
  StepInstances write(const Building& building, const WriteIfc::Params& params = {}, const WriteIfc::In& more = {}) {
    StepInstances instances = read_step(text(building, params, more));
    check_ifc(instances);
    return instances;
  }
  std::string error_of(const Building& building, const WriteIfc::Params& params = {}) {
    try {
      write(building, params);
    } catch (const Error& error) {
      EXPECT_TRUE(std::filesystem::is_empty(host->folder.path())) << "a file is left";
      return error.what();
    }
    return "no error";
  }
};

std::vector<StepInstance> all(const StepInstances& instances, const std::string& type) {
  std::vector<StepInstance> result;
  for (const auto& [id, instance] : instances)
    if (instance.type == type) result.push_back(instance);
  return result;
}

std::set<std::string> ids(const StepInstances& instances) {
  std::set<std::string> result;
  for (const auto* type : {"IFCWALL", "IFCSLAB", "IFCDOOR", "IFCWINDOW", "IFCSPACE", "IFCOPENINGELEMENT", "IFCPROJECT"})
    for (const auto& instance : all(instances, type)) result.insert(instance.fields[0]);
  return result;
}

/// The place of the site: its placement's location.
std::vector<double> site_place(const StepInstances& instances) {
  const auto placement = instances.at(refs_of(all(instances, "IFCSITE").at(0).fields[5]).at(0));
  const auto axes = instances.at(refs_of(placement.fields[1]).at(0));
  std::string list = instances.at(refs_of(axes.fields[0]).at(0)).fields[0];
  std::replace_if(
      list.begin(), list.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream numbers(list);
  std::vector<double> result(3);
  for (auto& v : result) numbers >> v;
  return result;
}

Building moved(const Building& building, const Eigen::Vector3d& by, double angle = 0) {
  Transform transform;
  transform.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  transform.translation = by;
  return transformed(building, transform);
}

TEST_F(IfcFile, HoldsWhatTheBuildingHas) {
  const auto instances = write(BoxBuilding::two_rooms());
  const auto count = [&](const char* type) { return all(instances, type).size(); };
  EXPECT_EQ(count("IFCPROJECT"), 1U);
  EXPECT_EQ(count("IFCBUILDINGSTOREY"), 1U);
  EXPECT_EQ(count("IFCSPACE"), 2U);
  EXPECT_EQ(count("IFCWALL"), 7U);
  EXPECT_EQ(count("IFCSLAB"), 2U);
  EXPECT_EQ(count("IFCDOOR"), 1U);
  EXPECT_EQ(count("IFCWINDOW"), 1U);
  EXPECT_EQ(count("IFCOPENINGELEMENT"), 2U);
  EXPECT_EQ(count("IFCRELVOIDSELEMENT"), 2U);
  EXPECT_EQ(count("IFCRELFILLSELEMENT"), 2U);
  EXPECT_EQ(count("IFCMAPCONVERSION"), 0U);
  EXPECT_EQ(count("IFCRELSPACEBOUNDARY"), 8U + 4U + 3U) << "walls, slabs, the door from both sides and the window";
  EXPECT_TRUE(host->warnings.empty());
}

TEST_F(IfcFile, SaysWhatWasSeenAndWhatAssumed) {
  Building building = BoxBuilding::two_rooms();
  building.rooms[0].confidence = 0.6;
  building.rooms[0].doubts = {"its floor was not seen"};
  const std::string file = text(building);
  EXPECT_NE(file.find("IFCPROPERTYSINGLEVALUE('Coverage',$,IFCREAL(0.9),$)"), std::string::npos);
  EXPECT_NE(file.find("IFCPROPERTYSINGLEVALUE('Residual',$,IFCLENGTHMEASURE(0.004),$)"), std::string::npos);
  EXPECT_NE(file.find("IFCPROPERTYSINGLEVALUE('ThicknessAssumed',$,IFCBOOLEAN(.T.),$)"), std::string::npos);
  EXPECT_NE(file.find("IFCPROPERTYSINGLEVALUE('RoomConfidence',$,IFCREAL(0.6),$)"), std::string::npos);
  EXPECT_NE(file.find("IFCPROPERTYSINGLEVALUE('Doubts',$,IFCTEXT('its floor was not seen'),$)"), std::string::npos);
  EXPECT_NE(file.find("IFCQUANTITYLENGTH('Width',$,$,0.12,$)"), std::string::npos);
}

TEST_F(IfcFile, EqualBuildingsHaveEqualIds) {
  const Building building = BoxBuilding::two_rooms();
  EXPECT_EQ(text(building), text(building));
  const auto first = ids(write(building));
  Building renamed = building;
  renamed.rooms[0].name = "hall";
  renamed.rooms[0].confidence = 0.5;
  EXPECT_EQ(ids(write(renamed)), first);
  WriteIfc::Params thicker;
  thicker.assumed_thickness = 0.3;
  EXPECT_EQ(ids(write(building, thicker)), first);
  const auto other = ids(write(moved(building, {3, 0, 0})));
  EXPECT_EQ(other.size(), first.size());
  for (const auto& id : other) EXPECT_FALSE(first.contains(id));
  WriteIfc::Params named;
  named.id_space = "house 7";
  EXPECT_EQ(ids(write(building, named)), ids(write(moved(building, {3, 0, 0}), named)));
}

TEST_F(IfcFile, NamesInAnyScriptComeBack) {
  Building building = BoxBuilding::two_rooms();
  building.rooms[0].name = "K\u00FCche '2' \\ \"x\"";
  building.rooms[1].name = "\u90E8\u5C4B \U0001F6AA";
  const auto spaces = all(write(building), "IFCSPACE");
  EXPECT_EQ(text_of(spaces.at(0).fields[2]), building.rooms[0].name);
  EXPECT_EQ(text_of(spaces.at(1).fields[7]), building.rooms[1].name);
}

TEST_F(IfcFile, TheMapHoldsThePlaceOnceAndTheSiteDoesWithoutOne) {
  const Building far = moved(BoxBuilding::two_rooms(), {503217.25, 5412345.75, 312.5}, 0.3);
  WriteIfc::Params params;
  params.crs = "urn:ogc:def:crs:EPSG::25832";
  const auto mapped = write(far, params);
  EXPECT_EQ(site_place(mapped), (std::vector<double>{0, 0, 0}));
  const auto map = all(mapped, "IFCMAPCONVERSION").at(0);
  EXPECT_NEAR(std::stod(map.fields[2]), 503217.25, 10);
  EXPECT_NEAR(std::stod(map.fields[3]), 5412345.75, 10);
  EXPECT_NEAR(std::stod(map.fields[4]), 312.5, 10);
  const auto crs = all(mapped, "IFCPROJECTEDCRS").at(0);
  EXPECT_EQ(crs.fields[0], "'EPSG:25832'");
  EXPECT_EQ(crs.fields[5], "'32N'");
  const auto local = write(far);
  EXPECT_NEAR(site_place(local)[1], 5412345.75, 10);
  EXPECT_TRUE(all(local, "IFCMAPCONVERSION").empty());
  EXPECT_EQ(site_place(write(BoxBuilding::two_rooms())), (std::vector<double>{0, 0, 0}));
  for (const auto* file : {&mapped, &local})
    for (const auto& [id, point] : *file)
      if (point.type == "IFCCARTESIANPOINT" && point.fields[0].find("5412") == std::string::npos) {
        EXPECT_LT(std::abs(std::stod(point.fields[0].substr(1))), 50) << "near the origin";
      }
}

TEST_F(IfcFile, TakesTheSystemOfTheScan) {
  Cloud scan;
  scan.crs = "PROJCS[\"x\",AUTHORITY[\"EPSG\",\"32633\"]]";
  WriteIfc::In more;
  more.scan = input(scan);
  EXPECT_EQ(all(write(BoxBuilding::two_rooms(), {}, more), "IFCPROJECTEDCRS").at(0).fields[0], "'EPSG:32633'");
  scan.unit = 0.3048;
  more.scan = input(scan);
  EXPECT_TRUE(all(write(BoxBuilding::two_rooms(), {}, more), "IFCPROJECTEDCRS").empty());
  EXPECT_TRUE(host->warnings.empty()) << "the reader has said so";
}

TEST_F(IfcFile, OfALyingScanNamesNoSystem) {
  Transform lying;  // from the input's frame, in which y is up
  lying.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  WriteIfc::In more;
  more.transform = input(lying);
  WriteIfc::Params params;
  params.crs = "EPSG:25832";
  EXPECT_TRUE(all(write(BoxBuilding::two_rooms(), params, more), "IFCPROJECTEDCRS").empty());
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_TRUE(host->warnings[0].starts_with("the building is turned upright, out of EPSG:25832"));
}

TEST_F(IfcFile, FurnitureIsThereIfItIsGiven) {
  Mesh mesh;
  mesh.vertices = {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}, {1, 1, 1}, {3, 1, 0}, {3.5, 1, 0}, {3, 1, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {4, 5, 6}};
  WriteIfc::In more;
  more.furniture = input(mesh);
  EXPECT_EQ(all(write(BoxBuilding::two_rooms(), {}, more), "IFCBUILDINGELEMENTPROXY").size(), 2U);
}

TEST_F(IfcFile, UnsoundInputIsRefusedAndLeavesNoFile) {
  const Building sound = BoxBuilding::two_rooms();
  Building building = sound;
  building.rooms[0].confidence = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of(building).find("room"), std::string::npos);
  building = sound;
  building.vertices[3].x() = std::numeric_limits<double>::infinity();
  EXPECT_NE(error_of(building), "no error");
  building = sound;
  building.openings[0].face_a = 99;
  EXPECT_NE(error_of(building).find("opening"), std::string::npos);
  WriteIfc::Params params;
  params.crs = "somewhere";
  EXPECT_NE(error_of(sound, params).find("names no coordinate reference system"), std::string::npos);
}

TEST_F(IfcFile, OddBuildingsAreWrittenWithWhatTheyHave) {
  EXPECT_TRUE(all(write(Building{}), "IFCWALL").empty());
  EXPECT_EQ(host->warnings.size(), 1U) << "it has no rooms";
  Building no_walls = BoxBuilding::two_rooms();
  std::erase_if(no_walls.rooms[1].faces, [](int f) { return f > 7; });
  for (auto& face : no_walls.faces)
    if (face.surface == SurfaceClass::wall) face.surface = SurfaceClass::object;
  const auto instances = write(no_walls);
  EXPECT_TRUE(all(instances, "IFCWALL").empty());
  EXPECT_EQ(all(instances, "IFCSPACE").size(), 2U);
  EXPECT_EQ(all(instances, "IFCDOOR").size(), 1U);
  EXPECT_EQ(all(instances, "IFCWINDOW").size(), 1U) << "they stand by themselves";
  EXPECT_TRUE(all(instances, "IFCRELVOIDSELEMENT").empty());
  EXPECT_EQ(host->warnings.size(), 2U);
}

TEST_F(IfcFile, ManyRoomsAreNoTrouble) {
  BoxBuilding b;
  for (int x = 0; x < 34; ++x)
    for (int y = 0; y < 34; ++y) b.room(4.0 * x, 3.0 * y, 4.0 * x + 3.9, 3.0 * y + 2.9);
  const auto instances = write(b.building);
  EXPECT_EQ(all(instances, "IFCSPACE").size(), 1156U);
  EXPECT_EQ(all(instances, "IFCWALL").size(), 2U * 34 * 35);
  EXPECT_EQ(all(instances, "IFCSLAB").size(), 2U);
  EXPECT_EQ(all(instances, "IFCRELSPACEBOUNDARY").size(), 6U * 1156);
}

/// Two storeys with doors, a window, a stair hole, rooms with gables and a column, turned and far away.
std::vector<std::pair<std::string, Building>> judged() {
  House attic;
  attic.room(House::gable(0, 0, 6, 4), 0, [](double x, double) { return 1 + 2 * (1 - std::abs(x - 3) / 3); });
  attic.building.openings.push_back(
      {"window", 0, -1, 1, -1, 0, {{1, 1, 5. / 3}, {1, 2, 5. / 3}, {2, 2, 7. / 3}, {2, 1, 7. / 3}}, {}});
  attic.building.openings.push_back(
      {"window", 0, -1, 3, -1, 0, {{2, 0, 0.5}, {2, 0, 1.5}, {4, 0, 1.5}, {4, 0, 0.5}}, {}});
  House column;
  House::Plan plan = House::rectangle(0, 0, 6, 5);
  plan.column = {{2, 2}, {2.4, 2}, {2.4, 2.5}, {2, 2.5}};
  column.room(plan, 0, [](double, double) { return 2.5; });
  House oblique;
  oblique.room({{{0, 0}, {5, 0}, {6.5, 4}, {0, 3}}, {}, {{0, 1, 2, 3}}, {}, {}}, 0,
               [](double x, double) { return 2.5 + 0.2 * x; });
  BoxBuilding storeys;
  storeys.building = BoxBuilding::two_rooms();
  storeys.building.storeys.push_back({2.8, 2.5});
  storeys.room(0, 0, 7, 3, 2.8, 5.3, 1);
  BuildingOpening hole{"slab", 2, 0, 12, 1, 0.3, {{2, 1, 2.8}, {3, 1, 2.8}, {3, 2, 2.8}, {2, 2, 2.8}}, {}};
  storeys.building.openings.push_back(hole);
  return {{"rooms", moved(BoxBuilding::two_rooms(), {503217.25, 5412345.75, 312.5}, 0.3)},
          {"attic", moved(attic.building, {0, 0, 0}, 0.4)},
          {"column", column.building},
          {"oblique", oblique.building},
          {"storeys", storeys.building}};
}

TEST_F(IfcFile, AnotherProgramFindsTheSameVolumes) {
  const auto build = std::filesystem::path(ATRIUM_PROGRAM).parent_path().parent_path();
  std::vector<std::string> command{ATRIUM_SOURCE_DIR "/tests/validate-ifc", build / "tests/web-ifc"};
  std::vector<StepInstances> written;
  const auto buildings = judged();
  for (const auto& [name, building] : buildings) {
    WriteIfc::Params params;
    params.path.path = name + ".ifc";
    written.push_back(write(building, params));
    command.push_back((host->folder / params.path.path).string());
  }
  EXPECT_TRUE(host->warnings.empty());
  const auto result = test::run_process(command);
  if (result.exit_code == 77) ATRIUM_SKIP_LACKING("web-ifc cannot be had: " << result.err);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  std::size_t file = 0;
  for (std::string line; std::getline(lines, line); ++file) {
    const json report = json::parse(line);
    const Building& building = buildings.at(file).second;
    EXPECT_EQ(report["schema"], "IFC4");
    EXPECT_TRUE(report["log"].empty()) << report["log"];
    for (const auto& [type, count] : report["counts"].items())
      EXPECT_EQ(count, all(written.at(file), type).size()) << type;
    EXPECT_EQ(report["counts"]["IFCSPACE"], building.rooms.size());
    EXPECT_EQ(report["counts"]["IFCOPENINGELEMENT"], building.openings.size());
    std::size_t space = 0, compared = 0;
    for (const auto& element : report["elements"]) {
      const double volume = element["volume"];
      if (element["type"] == "IFCSPACE") {
        EXPECT_NEAR(volume, building.rooms.at(space++).volume, 0.005 * volume);
      }
      EXPECT_GT(volume, 0) << element["name"];
      if (element["stated"].is_null()) continue;
      EXPECT_NEAR(volume, element["stated"].get<double>(), 0.005 * volume) << report["file"] << element["name"];
      ++compared;
    }
    EXPECT_GE(compared, building.rooms.size() + 4);
  }
  EXPECT_EQ(file, buildings.size());
}

}  // namespace
}  // namespace atrium::building::write_ifc_test
