#include "modules/plane/check_sides.hpp"

#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"

namespace atrium::plane::check_sides_test {
namespace {

using atrium::test::Rooms;

PlanePrimitives checked(const PlanePrimitives& planes) {
  Context context;
  return CheckSides::run({input(planes)}, {}, context).planes;
}

/// A large room, and a closet of 1.2 m × 0.9 m beside it whose ceiling looks up; both with their walls.
Rooms room_and_closet(double ceiling, bool walls) {
  Rooms scene;
  scene.floor(0, 0, 4, 4).ceiling(0, 0, 4, 4).walls({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  scene.floor(4.12, 0, 5.32, 0.9);
  if (walls) scene.walls({{4.12, 0}, {5.32, 0}, {5.32, 0.9}, {4.12, 0.9}}, 0, 0, ceiling);
  scene.add({4.12, 0, ceiling}, {1.2, 0, 0}, {0, 0.9, 0}, {0, 0, 1});
  return scene;
}

double looks(const PlanePrimitives& planes, std::size_t plane, int axis) {
  return planes.primitives[plane].plane.normal[axis];
}

TEST(CheckSides, AClosetsCeilingInThePlaneOfALargerOneLooksDown) {
  const PlanePrimitives planes = checked(room_and_closet(2.5, true).unsorted());
  const PlanePrimitive& closet = planes.primitives.back();
  EXPECT_EQ(closet.plane.normal.z(), -1);
  EXPECT_NEAR(closet.plane.signed_distance({4.5, 0.5, 2.5}), 0, 1e-9);
  for (std::size_t i = 0; i + 1 < planes.primitives.size(); ++i)
    EXPECT_EQ(planes.primitives[i].plane.normal, room_and_closet(2.5, true).unsorted().primitives[i].plane.normal) << i;
}

TEST(CheckSides, WithoutWallsOrAtAnotherHeightItStays) {
  const PlanePrimitives bare = checked(room_and_closet(2.5, false).unsorted());
  EXPECT_EQ(looks(bare, bare.primitives.size() - 1, 2), 1);
  const PlanePrimitives lower = checked(room_and_closet(2.4, true).unsorted());
  EXPECT_EQ(looks(lower, lower.primitives.size() - 1, 2), 1);
}

/// Two rooms with a cavity between them, whose wall at x = 4 looks into the cavity; `beyond`: the far wall there.
PlanePrimitives cavity(double beyond, bool floored) {
  Rooms scene;
  scene.floor(0, 0, 4, 4).ceiling(0, 0, 4, 4).wall(4, 4, 4, 0);
  if (floored) scene.floor(4, 0, beyond, 4).ceiling(4, 0, beyond, 4);
  return scene.wall(beyond, 4, beyond, 0).unsorted();
}

TEST(CheckSides, AWallWithTheRoomBehindItAndAnotherWallBeforeItIsTurned) {
  EXPECT_EQ(cavity(4.5, false).primitives[2].plane.normal.x(), 1);
  EXPECT_EQ(looks(checked(cavity(4.5, false)), 2, 0), -1);
  EXPECT_EQ(looks(checked(cavity(5.5, false)), 2, 0), 1) << "what is so wide may be a room";
  EXPECT_EQ(looks(checked(cavity(4.5, true)), 2, 0), 1) << "floor and ceiling on both sides";
}

TEST(CheckSides, RoomsThatAreRightStay) {
  const PlanePrimitives planes = atrium::test::l_room().unsorted(), same = checked(planes);
  for (std::size_t i = 0; i < planes.primitives.size(); ++i)
    EXPECT_EQ(same.primitives[i].plane.normal, planes.primitives[i].plane.normal) << i;
  EXPECT_TRUE(checked(PlanePrimitives{std::make_shared<const Cloud>(), {}}).primitives.empty());
}

}  // namespace
}  // namespace atrium::plane::check_sides_test
