#include "modules/building/correct.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "corrections.hpp"
#include "modules/building/elements.hpp"

namespace atrium::building::correct_test {
namespace {

using test::BoxBuilding;
using test::Corrections;
using test::House;

TEST_F(Corrections, WithoutAFileTheBuildingIsHandedOn) {
  Context context{1, host};
  const auto building = input(BoxBuilding::two_rooms());
  EXPECT_EQ(Correct::run({building, {}, {}}, {}, context).building, building);
}

TEST_F(Corrections, ARoomIsRenamedAndKnownByBothNames) {
  const Building result = corrected(BoxBuilding::two_rooms(),
                                    "  - rename_room: {room: room 1, name: Küche \"gross\"}\n"
                                    "  - set_ceiling: {room: room 1, height: 2.6}\n"
                                    "  - set_ceiling: {room: Küche \"gross\", height: 2.7 m}\n");
  expect_room(result, "Küche \"gross\"", 12, 12 * 2.7, 6);
  expect_room(result, "room 2", 8.64, 21.6, 6);
}

TEST_F(Corrections, AWallMovesAndTheWallGetsThinner) {
  const Building result = corrected(BoxBuilding::two_rooms(), "  - move_wall: {room: room 1, face: 3, by: 5 cm}\n");
  expect_room(result, "room 1", 4.05 * 3, 4.05 * 3 * 2.5, 6);
  expect_room(result, "room 2", 8.64, 21.6, 6);
  EXPECT_TRUE(says(room(result, "room 1"), "face 3 moved by 0.050 m"));
  EXPECT_TRUE(room(result, "room 2").doubts.empty());
  ASSERT_EQ(result.walls.size(), 1U);
  EXPECT_NEAR(result.walls[0].thickness, 0.07, 1e-9);
  EXPECT_NEAR(result.openings[0].thickness, 0.07, 1e-9);
  expect_box(result.openings[0].outline_a, {4.05, 0.5, 0}, {4.05, 1.4, 2.1});
  expect_box(result.openings[0].outline_b, {4.12, 0.5, 0}, {4.12, 1.4, 2.1});
  expect_box(room(result, "room 1").outline, {0, 0, 0}, {4.05, 3, 0});
  EXPECT_EQ(result.faces[3].primitive, 3);
  EXPECT_EQ(result.faces[3].observed, 0.9);
  EXPECT_NEAR(result.storeys[0].height, 2.5, 1e-9);
}

TEST_F(Corrections, BothFacesOfAWallMoveTogether) {
  const Building result =
      corrected(BoxBuilding::two_rooms(), "  - move_wall: {room: room 1, wall: wall 2, by: -0.5, both: true}\n");
  expect_room(result, "room 1", 3.5 * 3, 3.5 * 3 * 2.5, 6);
  expect_room(result, "room 2", 3.38 * 3, 3.38 * 3 * 2.5, 6);
  ASSERT_EQ(result.walls.size(), 1U);
  EXPECT_NEAR(result.walls[0].thickness, 0.12, 1e-9);
  expect_box(result.openings[0].outline_b, {3.62, 0.5, 0}, {3.62, 1.4, 2.1});
  EXPECT_TRUE(says(room(result, "room 1"), "wall 2 moved by -0.500 m"));
  EXPECT_TRUE(says(room(result, "room 2"), "wall 2 of room 1 moved by -0.500 m with the wall"));
}

TEST_F(Corrections, PlacesAreInTheScansFrameAndUnit) {
  // The scan is turned by 90 degrees about z and in feet, and its zero is (10, 20) in the building.
  Transform transform;
  transform.rotation = Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  transform.translation = {10, 20, 3};
  Building building = BoxBuilding::two_rooms();
  building.origin = {10, 20, 3};
  // (0, 1.5) of the building's room is (1.5, 0) of the scan.
  const Building result =
      corrected(building, "  - move_wall: {room: room 1, at: [" + std::to_string(1.5 / 0.3048) + ", 0.1], by: 1 ft}\n",
                transform, 0.3048);
  expect_room(result, "room 1", 4.3048 * 3, 4.3048 * 3 * 2.5, 6);
  expect_box(room(result, "room 1").outline, {-0.3048, 0, 0}, {4, 3, 0});
}

TEST_F(Corrections, CeilingsAndFloorsMoveWithTheFeetOfDoors) {
  const Building result = corrected(BoxBuilding::two_rooms(),
                                    "  - set_ceiling: {room: room 1, height: 2.8 m}\n"
                                    "  - set_ceiling: {room: room 2, by: -10 cm}\n"
                                    "  - set_floor: {room: room 1, level: 2 cm}\n");
  expect_room(result, "room 1", 12, 12 * 2.78, 6);
  expect_room(result, "room 2", 8.64, 8.64 * 2.4, 6);
  expect_box(result.openings[0].outline_a, {4, 0.5, 0.02}, {4, 1.4, 2.1});
  expect_box(result.openings[0].outline_b, {4.12, 0.5, 0}, {4.12, 1.4, 2.1});
  EXPECT_NEAR(result.storeys[0].elevation, 0.02, 1e-9) << "most of the storey's floor lies there";
  EXPECT_NEAR(result.storeys[0].height, (12 * 2.78 + 8.64 * 2.4) / 20.64, 1e-9);
  EXPECT_TRUE(says(room(result, "room 1"), "ceiling set to a height of 2.800 m"));
}

TEST_F(Corrections, DoorsAndWindowsAreAddedChangedAndDropped) {
  const Building result = corrected(
      BoxBuilding::two_rooms(),
      "  - add_opening: {room: room 1, face: 3, kind: door, corner: left, distance: 20 cm, width: 0.8, height: 2 m}\n"
      "  - add_opening: {room: room 2, at: [7.1, 1.5], kind: window, corner: right, distance: 0.4, width: 1.2, height: "
      "1.1, sill: 90 cm}\n"
      "  - change_opening: {opening: door 1, width: 1 m, kind: passage}\n"
      "  - drop_opening: {opening: window 1}\n");
  ASSERT_EQ(result.openings.size(), 3U);
  const BuildingOpening &passage = result.openings[0], &door = result.openings[1], &window = result.openings[2];
  EXPECT_EQ(passage.kind, "passage");
  expect_box(passage.outline_a, {4, 0.45, 0}, {4, 1.45, 2.1});
  expect_box(passage.outline_b, {4.12, 0.45, 0}, {4.12, 1.45, 2.1});
  // Seen from room 1 the left end of the wall x = 4 is at y = 3.
  EXPECT_EQ(door.kind, "door");
  EXPECT_EQ(door.room_a, 0);
  EXPECT_EQ(door.room_b, 1);
  EXPECT_EQ(door.face_b, 11);
  EXPECT_NEAR(door.thickness, 0.12, 1e-9);
  expect_box(door.outline_a, {4, 2.0, 0}, {4, 2.8, 2});
  expect_box(door.outline_b, {4.12, 2.0, 0}, {4.12, 2.8, 2});
  // And the right end of x = 7 seen from room 2 is at y = 0.
  EXPECT_EQ(window.room_a, 1);
  EXPECT_EQ(window.room_b, -1);
  expect_box(window.outline_a, {7, 0.4, 0.9}, {7, 1.6, 2.0});
  EXPECT_TRUE(says(result.rooms[0], "door of 0.80 m × 2.00 m added in face 3"));
  EXPECT_TRUE(says(result.rooms[1], "door of 0.80 m × 2.00 m added in face 3"));
  EXPECT_TRUE(says(result.rooms[0], "window 1 dropped"));
  EXPECT_TRUE(says(result.rooms[1], "door 1 changed to 1.00 m × 2.10 m, a passage"));
}

TEST_F(Corrections, AnOpeningMovesAlongItsWallSeenFromARoom) {
  const Building result =
      corrected(BoxBuilding::two_rooms(), "  - change_opening: {opening: door 1, room: room 2, by: 30 cm}\n");
  // Seen from room 2 the right of x = 4.12 is where y grows.
  expect_box(result.openings[0].outline_a, {4, 0.8, 0}, {4, 1.7, 2.1});
  expect_box(result.openings[0].outline_b, {4.12, 0.8, 0}, {4.12, 1.7, 2.1});
  EXPECT_EQ(result.openings[0].room_a, 0);
}

TEST_F(Corrections, TheWallBetweenMergedRoomsGoes) {
  Building building = BoxBuilding::two_rooms();
  building.rooms[0].confidence = 1;
  building.rooms[1].confidence = 0.5;
  building.rooms[1].doubts = {"its floor was not seen"};
  const Building result = corrected(building, "  - merge_rooms: {rooms: [room 1, room 2], name: Hall}\n");
  ASSERT_EQ(result.rooms.size(), 1U);
  expect_room(result, "Hall", 21, 52.5, 6);
  EXPECT_EQ(room(result, "Hall").outline.size(), 4U);
  EXPECT_NEAR(room(result, "Hall").confidence, (12 + 0.5 * 8.64) / 20.64, 1e-9);
  EXPECT_EQ(room(result, "Hall").doubts.front(), "its floor was not seen");
  EXPECT_TRUE(says(room(result, "Hall"), "merged from room 1 and room 2"));
  ASSERT_EQ(result.openings.size(), 1U) << "the door went with its wall";
  EXPECT_EQ(result.openings[0].kind, "window");
  EXPECT_TRUE(result.walls.empty());
  // Nobody saw the strip of floor where the wall stood.
  const BuildingFace& floor = result.faces[static_cast<std::size_t>(room(result, "Hall").faces[0])];
  EXPECT_EQ(floor.surface, SurfaceClass::floor);
  EXPECT_NEAR(floor.observed, 0.9 * 20.64 / 21, 1e-9);
}

TEST_F(Corrections, OnlyTheCommonPartOfAWallGoes) {
  BoxBuilding b;
  b.room(0, 0, 4, 3);
  b.room(4.1, 1, 6, 4, 0.01, 2.3);  // a centimetre higher, with a lower ceiling, half a metre further on
  const Building result = corrected(b.building, "  - merge_rooms: {rooms: [room 1, room 2]}\n");
  ASSERT_EQ(result.rooms.size(), 1U);
  // Of the wall the common 2 m go, floor to the lower ceiling.
  const double area = 12 + 1.9 * 3 + 0.1 * 2, volume = 30 + 1.9 * 3 * 2.3 + 0.1 * 2 * 2.3;
  expect_room(result, "room 1", area, volume, 11);
}

TEST_F(Corrections, ARoomIsSplitWithAndWithoutAWall) {
  const Building open = corrected(BoxBuilding::two_rooms(),
                                  "  - split_room: {room: room 1, from: [3, 1], to: [3, 2], names: [West, East]}\n");
  ASSERT_EQ(open.rooms.size(), 3U);
  expect_room(open, "West", 9, 22.5, 6);
  expect_room(open, "East", 3, 7.5, 6);
  const Building parted = corrected(BoxBuilding::two_rooms(),
                                    "  - split_room: {room: room 1, from: [3, 1], to: [3, 2], names: [West, East], "
                                    "thickness: 10 cm}\n"
                                    "  - merge_rooms: {rooms: [East, room 2], name: Right}\n");
  expect_room(parted, "West", 2.95 * 3, 2.95 * 7.5, 6);
  expect_room(parted, "Right", (7 - 3.05) * 3, (7 - 3.05) * 7.5, 6);
  ASSERT_EQ(parted.walls.size(), 1U);
  EXPECT_NEAR(parted.walls[0].thickness, 0.1, 1e-9);
  ASSERT_EQ(parted.openings.size(), 1U);
  EXPECT_EQ(parted.rooms[static_cast<std::size_t>(parted.openings[0].room_a)].name, "West");
  EXPECT_TRUE(says(room(parted, "West"), "split off from room 1"));
}

TEST_F(Corrections, ASplitRoomIsMergedAgain) {
  const Building result = corrected(BoxBuilding::two_rooms(),
                                    "  - split_room: {room: room 1, from: [1, 1], to: [3, 2], names: [A, B]}\n"
                                    "  - merge_rooms: {rooms: [A, B], name: room 1}\n");
  expect_room(result, "room 1", 12, 30, 6);
  EXPECT_EQ(result.openings.size(), 2U);
}

/// A room 4 m × 3 m whose wall y = 3 has a pilaster (or, with a negative depth, a niche) from x = 1 to 1.5.
Building with_pilaster(double depth) {
  House house;
  House::Plan plan;
  plan.plan = {{0, 0}, {4, 0}, {4, 3}, {1.5, 3}, {1.5, 3 - depth}, {1, 3 - depth}, {1, 3}, {0, 3}};
  plan.ceilings = {{0, 1, 2, 3, 4, 5, 6, 7}};
  house.room(plan, 0, [](double, double) { return 2.5; });
  return house.building;
}

const Wall& wall_of(const Elements& elements, const std::vector<std::int32_t>& faces) {
  const auto found =
      std::find_if(elements.walls.begin(), elements.walls.end(), [&](const Wall& w) { return w.faces == faces; });
  if (found == elements.walls.end()) throw std::runtime_error("no such wall");
  return *found;
}

TEST_F(Corrections, AnOuterWallGetsItsThickness) {
  const Building before = BoxBuilding::two_rooms();
  const Building result = corrected(before, "  - set_thickness: {room: room 1, face: 2, thickness: 36 cm}\n");
  EXPECT_EQ(result.faces[2].backing, 0.36);
  EXPECT_EQ(result.faces[2].corrections, std::vector<std::string>{"wall behind it set to 0.360 m"});
  EXPECT_TRUE(result.faces[5].corrections.empty());
  EXPECT_TRUE(says(room(result, "room 1"), "face 2 set to a thickness of 0.360 m"));
  EXPECT_TRUE(room(result, "room 2").doubts.empty());
  EXPECT_EQ(result.openings[1].thickness, 0.36) << "the window's wall";
  EXPECT_NEAR(result.openings[0].thickness, 0.12, 1e-9);
  expect_room(result, "room 1", 12, 30, 6);
  // What is built of it follows; its neighbours keep the assumed thickness.
  const Elements elements = elements_of(result, {}), old = elements_of(before, {});
  EXPECT_FALSE(wall_of(elements, {2}).assumed);
  EXPECT_EQ(wall_of(elements, {2}).thickness, 0.36);
  EXPECT_TRUE(wall_of(elements, {5}).assumed);
  EXPECT_EQ(wall_of(elements, {5}).thickness, 0.20);
  EXPECT_GT(wall_of(elements, {2}).gross_volume(), 4 * 2.5 * 0.36 - 1e-9);
  EXPECT_LT(wall_of(old, {2}).gross_volume(), 4.5 * 2.5 * 0.20);
}

TEST_F(Corrections, TheFarSideOfAGivenWallStaysWhenTheNearOneMoves) {
  const std::string set = "  - set_thickness: {room: room 1, at: [0, 1.5], thickness: 0.36}\n";
  EXPECT_NEAR(
      corrected(BoxBuilding::two_rooms(), set + "  - move_wall: {room: room 1, face: 5, by: 5 cm}\n").faces[5].backing,
      0.31, 1e-9);
  EXPECT_NEAR(
      corrected(BoxBuilding::two_rooms(), set + "  - move_wall: {room: room 1, face: 5, by: 5 cm, both: true}\n")
          .faces[5]
          .backing,
      0.36, 1e-12);
  EXPECT_EQ(refused(set + "  - move_wall: {room: room 1, face: 5, by: 0.36}\n"),
            "4:44: that is too far: face 5 is 0.360 m thick there, by set_thickness | a smaller value; or `both: "
            "true`, which moves the whole wall");
}

TEST_F(Corrections, AThicknessThatIsKnownOrHasNoRoomIsRefused) {
  EXPECT_EQ(refused("  - set_thickness: {room: room 1, face: 3, thickness: 0.3}\n"),
            "3:55: both faces of the wall behind face 3 are known: it is 0.120 m thick | move_wall moves one of them");
  EXPECT_EQ(refused("  - set_thickness: {room: room 1, face: 5, thickness: 1 mm}\n"),
            "3:55: 0.001 m is no thickness of a wall | 1 cm or more");
  EXPECT_PRED2(begins_with, refused("  - set_thickness: {room: room 1, face: 0, thickness: 0.3}\n"),
               "3:41: face 0 is a floor");
  BoxBuilding b;
  b.room(0, 0, 4, 3);
  b.room(5, 0, 7, 3);
  EXPECT_EQ(refused("  - set_thickness: {room: room 1, face: 3, thickness: 1.5}\n", b.building),
            "3:55: so thick the wall would reach into 'room 2' | that room begins 1.00 m behind face 3");
  EXPECT_EQ(corrected(b.building, "  - set_thickness: {room: room 1, face: 3, thickness: 0.9}\n").faces[3].backing,
            0.9);
  // The other room comes nearer afterwards: so far as the wall leaves it room.
  const std::string set = "  - set_thickness: {room: room 1, face: 3, thickness: 0.9}\n";
  EXPECT_EQ(refused(set + "  - move_wall: {room: room 2, face: 11, by: 0.2}\n", b.building),
            "4:5: the wall behind face 3, 0.900 m thick by set_thickness, would reach into 'room 2' | that room begins "
            "0.80 m behind face 3");
  EXPECT_NEAR(corrected(b.building, set + "  - move_wall: {room: room 2, face: 11, by: 0.05}\n").faces[3].backing, 0.9,
              1e-9);
  House house;
  House::Plan plan = House::rectangle(0, 0, 6, 5);
  plan.column = {{2, 2}, {2.4, 2}, {2.4, 2.4}, {2, 2.4}};
  house.room(plan, 0, [](double, double) { return 2.5; });
  EXPECT_PRED2(begins_with, refused("  - set_thickness: {room: room 1, face: 6, thickness: 0.3}\n", house.building),
               "3:55: no wall is behind face 6: it is a step or a column");
}

TEST_F(Corrections, AGivenThicknessIsThatOfItsOwnFaceAfterAMerge) {
  const Building result = corrected(BoxBuilding::two_rooms(),
                                    "  - set_thickness: {room: room 1, face: 2, thickness: 36 cm}\n"
                                    "  - merge_rooms: {rooms: [room 1, room 2], name: Hall}\n");
  expect_room(result, "Hall", 21, 52.5, 7);
  std::size_t given = 0;
  for (const auto& face : result.faces) {
    const bool says_so = std::find(face.corrections.begin(), face.corrections.end(), "wall behind it set to 0.360 m") !=
                         face.corrections.end();
    EXPECT_EQ(face.backing, says_so ? 0.36 : 0.0);
    if (!says_so) continue;
    ++given;
    EXPECT_NEAR(flat_polygon(result, face).area(), 4 * 2.5, 1e-6) << "what stood behind room 1";
  }
  EXPECT_EQ(given, 1U);
}

TEST_F(Corrections, WhatWasCorrectedSaysSo) {
  using Texts = std::vector<std::string>;
  const Building moved =
      corrected(BoxBuilding::two_rooms(),
                "  - move_wall: {room: room 1, face: 4, by: 3 cm}\n"
                "  - set_ceiling: {room: room 2, by: -5 cm}\n"
                "  - change_opening: {opening: door 1, height: 2 m}\n"
                "  - change_opening: {opening: window 1, kind: door}\n"
                "  - add_opening: {room: room 1, face: 4, kind: window, distance: 1, width: 1, height: 1, sill: 1}\n");
  EXPECT_EQ(moved.faces[4].corrections, Texts{"moved outwards by 0.030 m"});
  EXPECT_EQ(moved.faces[7].corrections, Texts{"lowered by 0.050 m"});
  for (const std::size_t f : {0, 1, 2, 3, 5, 6, 8, 9, 10, 11}) EXPECT_TRUE(moved.faces[f].corrections.empty()) << f;
  EXPECT_EQ(moved.openings[0].corrections, Texts{"changed"});
  EXPECT_EQ(moved.openings[1].corrections, Texts{"changed, was a window"});
  EXPECT_EQ(moved.openings[2].corrections, Texts{"added"});
  EXPECT_EQ(corrected(BoxBuilding::two_rooms(), "  - drop_opening: {opening: door 1}\n").faces[11].corrections,
            Texts{"door 1 dropped"});
  const Building split =
      corrected(BoxBuilding::two_rooms(), "  - split_room: {room: room 2, from: [5, 0], to: [5, 1], names: [A, B]}\n");
  std::map<std::string, int> told;
  for (const auto& face : split.faces) ++told[face.corrections.empty() ? "" : face.corrections.front()];
  // Of each part the floor, the ceiling and two walls are smaller, one is new and one as it was; room 1 is as it was.
  EXPECT_EQ(told,
            (std::map<std::string, int>{{"", 6 + 2}, {"new, by split_room", 2}, {"other shape, by split_room", 8}}));
}

TEST_F(Corrections, APilasterAndANicheAreDropped) {
  for (const double depth : {0.3, -0.3}) {
    const Building before = with_pilaster(depth);
    EXPECT_NEAR(before.rooms[0].area, 12 - 0.5 * depth, 1e-9);
    // Face 2 + i is the wall from corner i to the next.
    const Building result = corrected(before, "  - drop_face: {room: room 1, face: 6}\n");
    expect_room(result, "room 1", 12, 30, 6);
    EXPECT_TRUE(says(result.rooms[0], "face 6 dropped"));
  }
}

TEST_F(Corrections, NeighboursOfADroppedFaceAreExtendedUntilTheyMeet) {
  House house;
  House::Plan plan;
  plan.plan = {{0, 0}, {3, 0}, {4, 1}, {4, 3}, {0, 3}};
  plan.ceilings = {{0, 1, 2, 3, 4}};
  house.room(plan, 0, [](double, double) { return 2.5; });
  const Building result = corrected(house.building, "  - drop_face: {room: room 1, at: [3.5, 0.5]}\n");
  expect_room(result, "room 1", 12, 30, 6);
}

TEST_F(Corrections, AColumnIsDropped) {
  House house;
  House::Plan plan = House::rectangle(0, 0, 4, 3);
  plan.column = {{1, 1}, {1.4, 1}, {1.4, 1.4}, {1, 1.4}};
  house.room(plan, 0, [](double, double) { return 2.5; });
  const Building result = corrected(house.building, "  - drop_face: {room: room 1, face: 7}\n");
  expect_room(result, "room 1", 12, 30, 6);
  EXPECT_TRUE(result.rooms[0].holes.empty());
}

TEST_F(Corrections, UnderSlopesWallsMoveToo) {
  House house;
  house.room(House::gable(0, 0, 4, 5), 0, [](double x, double) { return 1 + std::min(x, 4 - x); });
  // The gable wall y = 5 is face 5 (two ceilings come before the walls).
  const Building longer = corrected(house.building, "  - move_wall: {room: room 1, face: 5, by: 1 m}\n");
  expect_room(longer, "room 1", 4 * 6, 4 * 6 * 2, 7);
  // The eaves x = 4 go on under the slope: half a metre further it is half a metre high.
  const Building wider = corrected(house.building, "  - move_wall: {room: room 1, face: 4, by: 0.5 m}\n");
  expect_room(wider, "room 1", 4.5 * 5, 5 * (8 + 0.5 * 0.75), 7);
}

}  // namespace
}  // namespace atrium::building::correct_test
