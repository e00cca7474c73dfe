// Rooms whose ceiling comes down to the floor: what is left of them, and in how many pieces.
#include "modules/layout/faces.hpp"

#include <gtest/gtest.h>

#include "graph/api/error.hpp"
#include "tests/unit/layout/cells.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::faces_test {
namespace {

using namespace atrium::test;

struct Result {
  Building building;
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();
};
Result faces_of(const std::vector<StoreyCells>& storeys) {
  PlanePrimitives planes;
  planes.cloud = std::make_shared<const Cloud>();
  planes.primitives.resize(2);
  Structure structure;
  structure.primitives = std::make_shared<const PlanePrimitives>(planes);
  CellComplex cells;
  cells.pixel = 0.05;
  cells.storeys = storeys;
  Result result;
  Context context(1, result.warnings);
  result.building = Faces::run({input(cells), input(structure)}, context).building;
  return result;
}
std::string refusal(const std::vector<StoreyCells>& storeys) {
  try {
    faces_of(storeys);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

/// Room a, of 4 m × 1 m, under a second ceiling that dips below the floor in its middle 2 m; and room b.
StoreyCells dipping() {
  StoreyCells cells = grid_cells({"......", ".aaaa.", "......", ".bbb..", "......"});
  cells.ceilings.push_back(level(-0.5, false));
  for (const int x : {2, 3}) grid_cell(cells, x, 3).ceiling = 1;
  return cells;
}

TEST(Faces, ARoomCutInTwoIsTwoRooms) {
  const auto [building, warnings] = faces_of({dipping()});
  ASSERT_EQ(building.rooms.size(), 3U);
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& room = building.rooms[r];
    EXPECT_EQ(room.name, "room " + std::to_string(r + 1));
    EXPECT_EQ(room.faces.size(), 6U);
    EXPECT_NEAR(room.area, r < 2 ? 1 : 3, 1e-9);
    EXPECT_EQ(room.outline.size(), 4U);
    for (const auto f : room.faces)
      EXPECT_EQ(building.faces.at(static_cast<std::size_t>(f)).room, static_cast<std::int32_t>(r));
  }
  EXPECT_TRUE(warnings->texts.empty());
}

TEST(Faces, ARoomOfWhichNothingIsLeftIsLeftOut) {
  StoreyCells cells = dipping();
  for (const int x : {1, 2, 3, 4}) grid_cell(cells, x, 3).ceiling = 1;
  const auto [building, warnings] = faces_of({cells});
  ASSERT_EQ(building.rooms.size(), 1U);
  EXPECT_EQ(building.rooms[0].name, "room 1");
  EXPECT_NEAR(building.rooms[0].area, 3, 1e-9);
  for (const auto& face : building.faces) EXPECT_EQ(face.room, 0);
  ASSERT_EQ(warnings->texts.size(), 1U);
  EXPECT_TRUE(warnings->mention("4.0 m2"));
}

TEST(Faces, CellsThatMeetOnlyWhereTheCeilingTouchesTheFloorAreTwoRooms) {
  StoreyCells cells = grid_cells({"....", ".aa.", "...."});
  cells.ceilings[0] = slanted(-2, {1, 0}, false);  // 0 at x = 2
  cells.ceilings.push_back(slanted(2, {-1, 0}, false));
  grid_cell(cells, 1, 1).ceiling = 1;
  const auto building = faces_of({cells}).building;
  ASSERT_EQ(building.rooms.size(), 2U);
  for (const auto& room : building.rooms) EXPECT_NEAR(room.volume, 0.5, 1e-9);
}

TEST(Faces, RoomsKeepTheirNumbersThroughStoreys) {
  const auto building = faces_of({grid_cells({"....", ".b..", "...."}), grid_cells({"....", ".aa.", "...."})}).building;
  ASSERT_EQ(building.rooms.size(), 2U);
  EXPECT_EQ(building.rooms[0].storey, 1);
  EXPECT_EQ(building.rooms[1].storey, 0);
}

TEST(Faces, CellsWithoutARoomAreRefused) {
  StoreyCells cells = grid_cells({"...", "...", "..."});
  EXPECT_NE(refusal({cells}).find("shows no room: nothing is inside"), std::string::npos) << refusal({cells});
  EXPECT_NE(refusal({cells}).find("no wall"), std::string::npos);
  cells.ceilings[0].primitive = -1;
  EXPECT_NE(refusal({cells}).find("no ceiling and no wall"), std::string::npos) << refusal({cells});
  EXPECT_NE(refusal({}).find("no floor and no ceiling"), std::string::npos) << refusal({});
  StoreyCells pinched = grid_cells({"...", ".a.", "..."});
  pinched.ceilings[0] = level(-0.5, false);
  EXPECT_NE(refusal({pinched}).find("nowhere above"), std::string::npos) << refusal({pinched});
}

}  // namespace
}  // namespace atrium::layout::faces_test
