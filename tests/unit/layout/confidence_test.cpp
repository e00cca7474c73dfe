// How far rooms can be trusted: a box room of 4 x 3 x 2.5 m as the building has it, and scans that show more or less of
// it.
#include "modules/layout/confidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "graph/api/error.hpp"
#include "modules/types/building_rules.hpp"
#include "tests/support/box_building.hpp"
#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::confidence_test {
namespace {

using namespace atrium::test;
using Scene = atrium::test::Rooms;

struct Judged {
  Building building;
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();
  std::string error;

  const BuildingRoom& room(std::size_t index = 0) const { return building.rooms.at(index); }
  bool doubts(const std::string& words, std::size_t index = 0) const {
    for (const auto& doubt : room(index).doubts)
      if (doubt.find(words) != std::string::npos) return true;
    return false;
  }
};

Judged judged(const Building& building, const Scene& scene, const Confidence::Params& params = {},
              const Transform& transform = {}) {
  Judged result;
  Context context(1, result.warnings);
  Structure structure;
  structure.primitives = std::make_shared<const PlanePrimitives>(scene.planes());
  try {
    result.building = Confidence::run({input(building), input(structure), input(transform)}, params, context).building;
    check(result.building);
  } catch (const Error& error) {
    result.error = error.what();
  }
  return result;
}
/// Keeps every room, to see its confidence.
Judged measured(const Building& building, const Scene& scene) { return judged(building, scene, {0, 0.5}); }

Building box(double height = 2.5) {
  BoxBuilding b;
  b.room(0, 0, 4, 3, 0, height);
  return b.building;
}
/// The parts of a box room: its walls by name.
struct Shown {
  bool floor = true, ceiling = true;
  std::string walls = "south east north west";
  double height = 2.5;
};
Scene shown(const Shown& what) {
  Scene scene;
  if (what.floor) scene.floor(0, 0, 4, 3);
  if (what.ceiling) scene.ceiling(0, 0, 4, 3, what.height);
  const auto has = [&](const char* wall) { return what.walls.find(wall) != std::string::npos; };
  if (has("south")) scene.wall(0, 0, 4, 0, 0, what.height);
  if (has("east")) scene.wall(4, 0, 4, 3, 0, what.height);
  if (has("north")) scene.wall(4, 3, 0, 3, 0, what.height);
  if (has("west")) scene.wall(0, 3, 0, 0, 0, what.height);
  return scene;
}

TEST(Confidence, AWholeRoomIsCertain) {
  const auto result = judged(box(), shown({}));
  ASSERT_EQ(result.building.rooms.size(), 1U) << result.error;
  EXPECT_DOUBLE_EQ(result.room().confidence, 1);
  EXPECT_DOUBLE_EQ(result.building.confidence, 1);
  EXPECT_TRUE(result.room().doubts.empty());
  EXPECT_EQ(result.warnings->texts,
            std::vector<std::string>{"no door or passage was found into 1 of 1 rooms (room 1)"});
}

TEST(Confidence, WithoutFloorOrCeilingItIsLessSoAndSaysWhy) {
  const auto no_floor = judged(box(), shown({.floor = false}));
  const auto no_ceiling = judged(box(), shown({.ceiling = false}));
  EXPECT_NEAR(no_floor.room().confidence, 0.85, 1e-9);
  EXPECT_NEAR(no_ceiling.room().confidence, 0.85, 1e-9);
  EXPECT_TRUE(no_floor.doubts("floor was not seen"));
  EXPECT_TRUE(no_ceiling.doubts("ceiling was not seen"));
}

TEST(Confidence, WallsAloneAreNoRoom) {
  const auto result = judged(box(), shown({.floor = false, .ceiling = false}));
  EXPECT_NE(result.error.find("no room"), std::string::npos);
  EXPECT_NE(result.error.find("neither its floor nor its ceiling"), std::string::npos) << result.error;
}

TEST(Confidence, FloorAndCeilingAloneAreNoRoom) {
  const auto result = judged(box(), shown({.walls = ""}));
  EXPECT_NE(result.error.find("0 % of its walls were seen"), std::string::npos) << result.error;
}

TEST(Confidence, ACornerIsNoRoomAndThreeWallsAreADoubtfulOne) {
  for (const char* two : {"south east", "west south"}) {
    const auto corner = judged(box(), shown({.walls = two}));
    EXPECT_NE(corner.error.find("of its outline"), std::string::npos) << corner.error;
  }
  const auto three = judged(box(), shown({.walls = "south east west"}));
  ASSERT_EQ(three.building.rooms.size(), 1U) << three.error;
  EXPECT_LT(three.room().confidence, 0.9);
  EXPECT_TRUE(three.doubts("walls were seen along 7"));
}

TEST(Confidence, MoreSeenIsNeverLessCertain) {
  double last = -1;
  for (const char* walls : {"", "south", "south east", "south east north", "south east north west"}) {
    const double confidence = measured(box(), shown({.walls = walls})).room().confidence;
    EXPECT_GE(confidence, last) << walls;
    last = confidence;
  }
  EXPECT_EQ(last, 1);
}

TEST(Confidence, WallsThatNeitherStandNorReachUpAreFurniture) {
  Scene scene;
  scene.floor(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 0, 0.8, 1.6);
  const auto result = judged(box(), scene);
  EXPECT_NE(result.error.find("stands on a floor or reaches a ceiling"), std::string::npos) << result.error;
}

TEST(Confidence, HeightsOutsideOfWhatRoomsHaveAreDoubted) {
  const auto confidence = [](double height) {
    return measured(box(height), shown({.height = height})).room().confidence;
  };
  EXPECT_EQ(confidence(1.0), 0);
  EXPECT_LT(confidence(1.5), 0.5);
  EXPECT_EQ(confidence(2.1), 1);
  EXPECT_EQ(confidence(4.9), 1);
  EXPECT_NEAR(confidence(8), 0.5, 0.05);
  EXPECT_GT(confidence(12), 0.4);
  EXPECT_NE(judged(box(0.6), shown({.height = 0.6})).error.find("too low to stand in"), std::string::npos);
}

TEST(Confidence, CupboardsAndSlitsAreNoRooms) {
  for (const double depth : {0.6, 0.2}) {
    BoxBuilding b;
    b.room(0, 0, depth == 0.2 ? 6 : 0.8, depth);
    Scene scene;
    const double width = depth == 0.2 ? 6 : 0.8;
    scene.floor(0, 0, width, depth).ceiling(0, 0, width, depth);
    scene.walls({{0, 0}, {width, 0}, {width, depth}, {0, depth}});
    const auto result = judged(b.building, scene);
    EXPECT_NE(result.error.find(depth == 0.2 ? "slit" : "less than a room"), std::string::npos) << result.error;
  }
}

TEST(Confidence, AWallAcrossARoomIsADoubtAndACupboardIsNone) {
  Scene wall = shown({});
  wall.wall(2, 0, 2, 3).wall(2.12, 3, 2.12, 0);
  EXPECT_LT(measured(box(), wall).room().confidence, 0.9);
  EXPECT_TRUE(measured(box(), wall).doubts("walls from floor to ceiling stand in it"));
  Scene cupboard = shown({});
  cupboard.wall(2, 0, 2, 3, 0, 1.8).wall(2.5, 3, 2.5, 0, 0, 1.8);
  EXPECT_EQ(measured(box(), cupboard).room().confidence, 1);
}

TEST(Confidence, ALevelThatWasTakenForAnotherIsADoubt) {
  // The floor that was seen lies half a metre higher, the ceiling half a metre lower than the building has them.
  Scene raised, bed = shown({false});
  bed.floor(1, 1, 3, 3, 0.5).floor(0, 0, 4, 1).floor(3, 1, 4, 3).floor(0, 1, 1, 3);
  EXPECT_FALSE(measured(box(), bed).doubts("another floor lies over"));
  raised.floor(0, 0, 4, 3, 0.5).ceiling(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  EXPECT_TRUE(measured(box(), raised).doubts("another floor lies over"));
  Scene lowered;
  lowered.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3, 2.1).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  EXPECT_TRUE(measured(box(), lowered).doubts("another ceiling hangs under"));
}

TEST(Confidence, RoomsThatOverlapAreDoubted) {
  BoxBuilding b;
  b.room(0, 0, 4, 3);
  b.room(0, 0, 4, 3, 1, 3.5);
  const auto result = measured(b.building, shown({}));
  EXPECT_TRUE(result.doubts("lie in another room", 0));
  EXPECT_TRUE(result.doubts("lie in another room", 1));
}

TEST(Confidence, APartOfARoomWithoutACeilingIsADoubt) {
  Scene scene = shown({.ceiling = false});
  scene.ceiling(0, 0, 1.5, 3);
  const auto part = measured(box(), scene);
  EXPECT_TRUE(part.doubts("no ceiling was seen over a part"));
  EXPECT_LT(part.room().confidence, 0.75);
  EXPECT_FALSE(measured(box(), shown({})).doubts("no ceiling was seen over a part"));
  // Where no ceiling was scanned at all, that is said instead.
  EXPECT_FALSE(measured(box(), shown({.ceiling = false})).doubts("over a part"));
}

TEST(Confidence, RoomsWithoutAWayInAreNamed) {
  Scene scene = shown({});
  scene.floor(4.12, 0, 7, 3).ceiling(4.12, 0, 7, 3).walls({{4.12, 0}, {7, 0}, {7, 3}, {4.12, 3}});
  Building building = BoxBuilding::two_rooms();
  EXPECT_TRUE(judged(building, scene).building.doubts.empty());
  building.openings.erase(building.openings.begin());  // the door
  const auto closed = judged(building, scene);
  ASSERT_EQ(closed.building.doubts.size(), 1U);
  EXPECT_EQ(closed.building.doubts[0], "no door or passage was found into 2 of 2 rooms (room 1; room 2)");
  EXPECT_TRUE(closed.warnings->mention("no door or passage"));
  building.openings.clear();
  EXPECT_TRUE(judged(building, scene).warnings->mention("no door or passage was found into 2 of 2 rooms"));
  EXPECT_TRUE(measured(box(), shown({})).warnings->mention("no door or passage was found into 1 of 1 rooms"));
}

TEST(Confidence, WallsThatEndBelowACeilingThatGoesOnAreDoubted) {
  Scene scene = shown({true, true, "south east north"});
  scene.wall(0, 3, 0, 0, 0, 2.3).ceiling(-0.3, 0, 0, 3);
  EXPECT_TRUE(measured(box(), scene).doubts("3.0 m of its walls end below a ceiling that goes on behind them"));
  EXPECT_FALSE(measured(box(), shown({})).doubts("below a ceiling"));
}

TEST(Confidence, FloorUnderACeilingThatNoRoomHoldsIsWarnedOf) {
  Scene scene = shown({});
  scene.floor(5, 0, 9, 3).ceiling(5, 0, 9, 3);
  const auto result = judged(box(), scene);
  ASSERT_EQ(result.building.rooms.size(), 1U) << result.error;
  EXPECT_LT(result.building.confidence, 0.7);
  EXPECT_TRUE(result.warnings->mention("in no room"));
  ASSERT_EQ(result.building.doubts.size(), 2U);  // there is no door
  // A table's underside is no ceiling, and a balcony's slab of 1 m2 too little to tell.
  Scene small = shown({});
  small.ceiling(1, 1, 3, 2, 0.7).floor(5, 0, 6, 1).ceiling(5, 0, 6, 1);
  EXPECT_DOUBLE_EQ(judged(box(), small).building.confidence, 1);
}

TEST(Confidence, FloorBetweenWallsBesideTheRoomsIsWarnedOfAndATerraceIsNot) {
  // What is seen of the next room through its door: floor, and the wall opposite up to the door's lintel.
  const auto beyond = [](double floor, double wall_top, double z = 0) {
    Scene scene = shown({});
    scene.floor(4.1, 1, 4.1 + floor, 2, z);
    if (wall_top > 0) scene.wall(4.1 + floor, 1, 4.1 + floor, 2, z, wall_top);
    return judged(box(), scene);
  };
  const auto room = beyond(3, 2);
  EXPECT_TRUE(room.warnings->mention("m2 of floor between walls are in no room (the largest piece"));
  EXPECT_GT(room.building.confidence, 0.75);
  EXPECT_LT(room.building.confidence, 0.99);
  EXPECT_FALSE(beyond(3, 0).warnings->mention("between walls")) << "a terrace";
  EXPECT_FALSE(beyond(3, 1.1).warnings->mention("between walls")) << "a terrace with a parapet";
  EXPECT_FALSE(beyond(3, 2, -0.3).warnings->mention("between walls")) << "the ground outside";
  EXPECT_FALSE(beyond(0.6, 2).warnings->mention("between walls")) << "a threshold";
}

TEST(Confidence, ARoomOverAMissingOneHidesNothing) {
  const auto seen = [](double upper_floor) {
    Scene scene = shown({});
    scene.floor(4.1, 1, 7.1, 2).wall(7.1, 1, 7.1, 2, 0, 2);
    scene.floor(4.1, 0, 8, 3, upper_floor)
        .walls({{4.1, 0}, {8, 0}, {8, 3}, {4.1, 3}}, 0, upper_floor, upper_floor + 2.5);
    BoxBuilding b;
    b.room(0, 0, 4, 3);
    b.room(4.1, 0, 8, 3, upper_floor, upper_floor + 2.5, upper_floor > 1 ? 1 : 0);
    b.building.storeys.push_back({2.8, 2.5});
    const auto result = judged(b.building, scene);
    EXPECT_EQ(result.error, "");
    return result.warnings->mention("m2 of floor between walls are in no room");
  };
  EXPECT_TRUE(seen(2.8));
  EXPECT_FALSE(seen(0)) << "the room itself";
}

TEST(Confidence, AHallWhoseCeilingIsHigherThanItsRoomIsWarnedOf) {
  Scene scene = shown({.ceiling = false, .height = 5});
  scene.ceiling(0, 0, 4, 3, 5);
  EXPECT_TRUE(judged(box(2.5), scene).warnings->mention("in no room"));
}

/// Two rooms with a door between them; of the second nothing was seen.
TEST(Confidence, WhatIsNoRoomIsLeftOutWithAWarning) {
  const Building two = BoxBuilding::two_rooms();
  Scene scene = shown({});
  const auto result = judged(two, scene);
  ASSERT_EQ(result.building.rooms.size(), 1U) << result.error;
  EXPECT_EQ(result.room().name, "room 1");
  EXPECT_EQ(result.building.faces.size(), 6U);
  EXPECT_EQ(result.building.vertices.size(), 8U);
  EXPECT_TRUE(result.building.walls.empty());
  ASSERT_EQ(result.building.openings.size(), 2U);
  EXPECT_EQ(result.building.openings[0].room_a, 0);
  EXPECT_EQ(result.building.openings[0].room_b, -1);
  EXPECT_EQ(result.building.openings[0].face_b, -1);
  EXPECT_TRUE(result.building.openings[0].outline_b.empty());
  EXPECT_TRUE(result.warnings->mention("room 2 (8.6 m2"));
  EXPECT_TRUE(result.warnings->mention("left out"));
}

TEST(Confidence, TheFirstRoomMayBeTheOneThatIsLeftOut) {
  Scene scene;
  scene.floor(4.12, 0, 7, 3).ceiling(4.12, 0, 7, 3).walls({{4.12, 0}, {7, 0}, {7, 3}, {4.12, 3}});
  const auto result = judged(BoxBuilding::two_rooms(), scene);
  ASSERT_EQ(result.building.rooms.size(), 1U) << result.error;
  EXPECT_EQ(result.room().name, "room 2");
  ASSERT_EQ(result.building.openings.size(), 1U);
  EXPECT_EQ(result.building.openings[0].room_a, 0);
  EXPECT_EQ(result.building.openings[0].outline_a, BoxBuilding::two_rooms().openings[0].outline_b);
  for (const auto& face : result.building.faces) EXPECT_EQ(face.room, 0);
}

TEST(Confidence, StoreysWithoutRoomsAreLeftOut) {
  BoxBuilding b;
  b.building.storeys = {{-3, 2.5}, {0, 2.5}};
  b.room(0, 0, 4, 3, -3, -0.5, 0);
  b.room(0, 0, 4, 3, 0, 2.5, 1);
  const auto result = judged(b.building, shown({}));
  ASSERT_EQ(result.building.storeys.size(), 1U) << result.error;
  EXPECT_EQ(result.building.storeys[0].elevation, 0);
  EXPECT_EQ(result.room().storey, 0);
  for (const auto& face : result.building.faces) EXPECT_EQ(face.storey, 0);
}

TEST(Confidence, AnUncertainAxisIsADoubtOfTheBuilding) {
  Transform transform;
  transform.upright = 0.6;
  const auto result = judged(box(), shown({}), {}, transform);
  EXPECT_NEAR(result.building.confidence, 0.6, 1e-12);
  EXPECT_DOUBLE_EQ(result.room().confidence, 1);
  EXPECT_TRUE(result.warnings->mention("which way is up is not certain (60 %)"));
  ASSERT_EQ(result.building.doubts.size(), 2U);  // there is no door
  // Above 90 % it is no doubt of its own, but counts as much as it is.
  transform.upright = 0.95;
  const auto likely = judged(box(), shown({}), {}, transform);
  EXPECT_NEAR(likely.building.confidence, 0.95, 1e-12);
  EXPECT_EQ(likely.building.doubts.size(), 1U) << "there is no door";
}

TEST(Confidence, PointsThatAreFarApartAreADoubtOfTheBuilding) {
  double before = 1;
  for (const double spacing : {0.05, 0.1, 0.15}) {
    Scene scene;
    scene.spacing = spacing;
    scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).wall(0, 0, 4, 0).wall(4, 0, 4, 3).wall(4, 3, 0, 3).wall(0, 3, 0, 0);
    Building building = box();
    const auto primitives = static_cast<std::int32_t>(scene.planes().primitives.size());
    ASSERT_EQ(building.faces.size(), static_cast<std::size_t>(primitives));
    for (std::int32_t f = 0; f < primitives; ++f) {  // whichever is whose: all are used, and seen whole
      building.faces[static_cast<std::size_t>(f)].primitive = f;
      building.faces[static_cast<std::size_t>(f)].observed = 1;
    }
    const auto result = measured(building, scene);
    EXPECT_EQ(result.warnings->mention("cm apart: doors, windows"), spacing > 0.08)
        << spacing << (result.warnings->texts.empty() ? "" : result.warnings->texts[0]);
    EXPECT_TRUE(spacing < 0.08 || result.building.confidence < before) << spacing;
    before = result.building.confidence;
  }
}

TEST(Confidence, WallsThatWereSeenTwiceAreADoubtOfTheBuilding) {
  for (const double degrees : {0.0, 3.0})
    for (const double shift : {0.0, 0.1}) {
      Scene scene = shown({});
      const Eigen::Rotation2Dd turn(degrees * EIGEN_PI / 180);
      const auto at = [&](double x, double y) -> Eigen::Vector2d {
        return turn * Eigen::Vector2d(x + shift, y + shift);
      };
      const Eigen::Vector2d corners[] = {at(0, 0), at(4, 0), at(4, 3), at(0, 3)};
      for (int c = 0; c < 4; ++c) {
        const Eigen::Vector2d a = corners[c], b = corners[(c + 1) % 4];
        scene.wall(a.x(), a.y(), b.x(), b.y());
      }
      const auto result = judged(box(), scene);
      const bool twice = degrees > 0 || shift > 0;
      EXPECT_EQ(result.warnings->mention("of the walls were seen twice"), twice) << degrees << ' ' << shift;
      EXPECT_EQ(result.building.confidence < 0.75, twice) << degrees << ' ' << shift;
    }
}

TEST(Confidence, ACupboardAndAWallThatStepsBackAreNoSecondLayers) {
  Scene scene = shown({});
  scene.wall(1, 0.3, 1.9, 0.3, 0, 2.5);  // before the wall at y = 0, which is seen all the same
  EXPECT_FALSE(judged(box(), scene).warnings->mention("seen twice"));
}

TEST(Confidence, DoubtfulRoomsAreWarnedOfAndNamedWhereTheyAre) {
  Building building = with_origin(box(), {-500000, 0, 0});
  building.origin.setZero();  // the room stands at x = 500,000 m
  Scene scene = shown({.walls = "south east west"});
  scene.origin({500000, 0, 0});
  const auto result = judged(building, scene, {0.15, 0.99});
  EXPECT_TRUE(result.warnings->mention("room 1 (12.0 m2 around x 500002.0, y 1.5")) << result.warnings->texts.at(0);
  EXPECT_TRUE(result.warnings->mention("compare it with the scan"));
  EXPECT_EQ(result.building.origin, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace atrium::layout::confidence_test
