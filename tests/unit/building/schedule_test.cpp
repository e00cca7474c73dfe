#include "modules/building/schedule.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "houses.hpp"
#include "writing_host.hpp"

namespace atrium::building::schedule_test {
namespace {

using test::BoxBuilding;

using Row = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      result.back() += line[i++];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      result.emplace_back();
    else if (line[i] != '\r')
      result.back() += line[i];
  }
  return result;
}

class Schedules : public ::testing::Test {
 protected:
  std::shared_ptr<test::WritingHost> host = std::make_shared<test::WritingHost>();
  Context context{1, host};

  void write(const Building& building) { Schedule::run({input(building), {}}, {}, context); }
  std::vector<Row> rows(const std::string& name) const {
    std::ifstream file(host->folder / name);
    std::string line;
    std::getline(file, line);
    const auto head = cells(line);
    std::vector<Row> result;
    while (std::getline(file, line)) {
      const auto values = cells(line);
      EXPECT_EQ(values.size(), head.size()) << line;
      result.emplace_back();
      for (std::size_t i = 0; i < head.size(); ++i) result.back()[head[i]] = values.at(i);
    }
    return result;
  }
};

TEST_F(Schedules, RoomsHaveTheirAreasPerimetersAndOpenings) {
  Building building = BoxBuilding::two_rooms();
  building.rooms[0].name = "K\u00FCche, \"gross\"";
  building.rooms[1].confidence = 0.75;
  building.rooms[1].doubts = {"a", "b"};
  write(building);
  const auto rooms = rows("rooms.csv");
  ASSERT_EQ(rooms.size(), 2U);
  EXPECT_EQ(rooms[0].at("name"), building.rooms[0].name);
  EXPECT_EQ(rooms[0].at("area_m2"), "12.000");
  EXPECT_EQ(rooms[0].at("perimeter_m"), "14.000");
  EXPECT_EQ(rooms[0].at("height_m"), "2.500");
  EXPECT_EQ(rooms[0].at("volume_m3"), "30.000");
  EXPECT_EQ(rooms[0].at("floor_m2"), "12.000");
  EXPECT_EQ(rooms[0].at("walls_gross_m2"), "35.000");
  EXPECT_EQ(rooms[0].at("walls_net_m2"), "31.310");  // a door of 0.9 m × 2.1 m, a window of 1.5 m × 1.2 m
  EXPECT_EQ(rooms[1].at("walls_net_m2"), "27.510");
  EXPECT_EQ(rooms[0].at("doors") + rooms[0].at("windows") + rooms[1].at("doors") + rooms[1].at("windows"), "1110");
  EXPECT_EQ(rooms[0].at("confidence"), "");
  EXPECT_EQ(rooms[1].at("confidence"), "0.750");
  EXPECT_EQ(rooms[1].at("doubts"), "a; b");
}

TEST_F(Schedules, DoorsAndWindowsNameTheirRoomsAndWalls) {
  write(BoxBuilding::two_rooms());
  const auto doors = rows("doors.csv"), windows = rows("windows.csv"), walls = rows("walls.csv");
  ASSERT_EQ(doors.size(), 1U);
  EXPECT_EQ(doors[0].at("kind"), "door");
  EXPECT_EQ(doors[0].at("from_room"), "room 1");
  EXPECT_EQ(doors[0].at("to_room"), "room 2");
  EXPECT_EQ(doors[0].at("width_m"), "0.900");
  EXPECT_EQ(doors[0].at("height_m"), "2.100");
  EXPECT_EQ(doors[0].at("sill_m"), "0.000");
  EXPECT_EQ(doors[0].at("wall_thickness_m"), "0.120");
  ASSERT_EQ(windows.size(), 1U);
  EXPECT_EQ(windows[0].at("sill_m"), "0.900");
  EXPECT_EQ(windows[0].at("area_m2"), "1.800");
  EXPECT_EQ(windows[0].at("to_room"), "");
  EXPECT_EQ(windows[0].at("wall_thickness_m"), "");
  ASSERT_EQ(walls.size(), 7U);
  for (const auto& wall : walls) {
    const bool has_door = wall.at("name") == doors[0].at("wall"), has_window = wall.at("name") == windows[0].at("wall");
    EXPECT_EQ(wall.at("doors_and_windows"), has_door || has_window ? "1" : "0");
    EXPECT_EQ(wall.at("thickness_assumed"), has_door ? "no" : "yes");
    EXPECT_EQ(wall.at("thickness_m"), has_door ? "0.120" : "0.200");
    EXPECT_NEAR(std::stod(wall.at("gross_m2")) - std::stod(wall.at("net_m2")),
                has_door     ? 1.89
                : has_window ? 1.8
                             : 0,
                1e-9);
    EXPECT_EQ(wall.at("height_m"), "2.500");
    EXPECT_EQ(wall.at("coverage"), "0.900");
  }
}

TEST_F(Schedules, WallsNameTheirFacesAndWhatWasCorrected) {
  Building building = BoxBuilding::two_rooms();
  building.faces[2].backing = 0.36;
  building.faces[2].corrections = {"wall behind it set to 0.360 m"};
  building.openings[0].corrections = {"changed"};
  write(building);
  std::map<std::string, std::string> thickness, corrected, assumed;
  for (const auto& wall : rows("walls.csv")) {
    thickness[wall.at("faces")] = wall.at("thickness_m");
    corrected[wall.at("faces")] = wall.at("corrected");
    assumed[wall.at("faces")] = wall.at("thickness_assumed");
  }
  EXPECT_EQ(thickness.size(), 7U) << "each wall has its own faces";
  EXPECT_EQ(thickness.at("2"), "0.360");
  EXPECT_EQ(assumed.at("2") + corrected.at("2"), "noyes");
  EXPECT_EQ(thickness.at("3 11"), "0.120");
  EXPECT_EQ(assumed.at("5") + corrected.at("5"), "yesno");
  EXPECT_EQ(rows("doors.csv")[0].at("corrected"), "yes");
  EXPECT_EQ(rows("windows.csv")[0].at("corrected"), "no");
}

TEST_F(Schedules, OfNothingThereAreNoRows) {
  write(Building{});
  for (const auto* name : {"rooms.csv", "doors.csv", "windows.csv", "walls.csv"}) EXPECT_TRUE(rows(name).empty());
  EXPECT_EQ(host->warnings.size(), 1U);
}

TEST_F(Schedules, UnsoundBuildingsLeaveNoFile) {
  Building building = BoxBuilding::two_rooms();
  building.rooms[1].area = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write(building), Error);
  EXPECT_TRUE(std::filesystem::is_empty(host->folder.path()));
}

}  // namespace
}  // namespace atrium::building::schedule_test
