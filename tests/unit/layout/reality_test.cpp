// What scans of real buildings show beside plain rooms: ground outside, raised floors, beams, rooms without a ceiling.
#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::reality_test {
namespace {

using namespace atrium::test;
using Scene = atrium::test::Rooms;

Scene& add_box(Scene& scene, double x0, double y0, double x1, double y1, double bottom = 0, double top = 2.5,
               bool ceiling = true) {
  if (ceiling) scene.ceiling(x0, y0, x1, y1, top);
  return scene.floor(x0, y0, x1, y1, bottom).walls({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, 0, bottom, top);
}

TEST(Reality, GroundOutsideIsNoFloorHoweverLarge) {
  Scene scene;
  add_box(scene, 0, 0, 5, 4);
  scene.floor(-4, -16, 12, -1.5, -0.5);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 20, 1e-3);
  EXPECT_NEAR(layout.building.rooms[0].height, 2.5, 1e-3);
}

TEST(Reality, ASmallRoomMayStandHigherThanALargeOne) {
  Scene scene;
  add_box(scene, 0, 0, 7, 5, 0, 2.6);
  add_box(scene, 7.12, 0, 9, 3, 0.5, 3.1);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_NEAR(layout.building.rooms[1].area, 5.64, 1e-3);
  EXPECT_NEAR(layout.building.rooms[1].height, 2.6, 1e-3);
}

TEST(Reality, ABedInACornerIsNoFloor) {
  Scene scene;
  add_box(scene, 0, 0, 5, 4);
  scene.floor(0, 0, 2, 2.2, 0.5).wall(2, 2.2, 2, 0, 0, 0.5).wall(0, 2.2, 2, 2.2, 0, 0.5);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].volume, 50, 0.01);
}

TEST(Reality, ABedIsNoFloorWhereTheFloorWasNotScanned) {
  Scene scene;
  scene.ceiling(0, 0, 5, 4).walls({{0, 0}, {5, 0}, {5, 4}, {0, 4}}, 0, 0, 2.5);
  scene.floor(1, 1, 3, 3.2, 0.5);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].height, 2.5, 0.1);
}

TEST(Reality, ATerraceBehindGlassIsOutsideHoweverWalled) {
  Scene scene;
  scene.floor(0, 0, 5, 8).ceiling(0, 0, 5, 4).wall(0, 0, 5, 0).wall(5, 0, 5, 4).wall(0, 4, 0, 0);
  // Of the front the frame: its sill and its posts.
  scene.wall(5, 4, 0, 4, 2.2, 2.5).wall(0.3, 4, 0, 4).wall(5, 4, 4.7, 4);
  scene.wall(5, 4.3, 5, 8, 0, 2).wall(5, 8, 0, 8, 0, 2).wall(0, 8, 0, 4.3, 0, 2);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 20, 0.1);
}

/// A room of 5 x 4 m with a cupboard along most of its wall at x = 0, 60 cm deep and 2.5 m long, which ends `gap` below
/// the ceiling: nothing is seen of the floor behind its front, and of wall and ceiling what may be seen over it.
Scene fitted_room(double gap) {
  Scene scene;
  scene.spacing = 0.025;
  const double top = 2.5 - gap;
  scene.ceiling(0, 0, 5, 4, 2.5, [](const auto& p) { return p.x() > 0.2 || p.y() > 2.5; });
  scene.floor(0, 0, 5, 4, 0, [](const auto& p) { return p.x() > 0.6 || p.y() > 2.5; });
  scene.wall(0.6, 2.5, 0.6, 0, 0, top).wall(0, 2.5, 0.6, 2.5, 0, top).wall(0, 4, 0, 2.5).wall(0, 2.5, 0, 0, 2.3, 2.5);
  scene.wall(0.6, 0, 5, 0).wall(5, 0, 5, 4).wall(5, 4, 0, 4).wall(0, 0, 0.6, 0, top, 2.5);
  return scene;
}

TEST(Reality, ACupboardThatEndsBelowTheCeilingIsNoWall) {
  for (const double gap : {0.15, 0.25}) {
    const auto layout = laid_out(fitted_room(gap).planes());
    ASSERT_EQ(layout.building.rooms.size(), 1U);
    EXPECT_NEAR(layout.building.rooms[0].area, 20, 0.05) << gap;
  }
}

TEST(Reality, AWorktopIsNoRaisedFloorAndAShelfInACornerNoCeiling) {
  // Worktops along three walls: walls stand around most of them, as they do around a raised room.
  Scene kitchen;
  add_box(kitchen, 0, 0, 4, 3);
  kitchen.floor(0, 0, 4, 3, 0.9, [](const auto& p) { return p.x() < 0.65 || p.x() > 3.35 || p.y() < 0.65; });
  kitchen.wall(0.65, 3, 0.65, 0.65, 0, 0.9).wall(0.65, 0.65, 3.35, 0.65, 0, 0.9).wall(3.35, 0.65, 3.35, 3, 0, 0.9);
  auto layout = laid_out(kitchen.planes());
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].volume, 30, 0.05);
  // The underside of a shelf around a corner fills most of a square of 80 cm there.
  Scene store;
  add_box(store, 0, 0, 4, 3);
  store.ceiling(0, 0, 4, 3, 1.95, [](const auto& p) { return p.x() < 0.45 || p.y() < 0.45; });
  layout = laid_out(store.planes());
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].volume, 30, 0.05);
}

TEST(Reality, ABeamUnderTheCeilingPartsNoRoom) {
  Scene scene;
  add_box(scene, 0, 0, 6, 4, 0, 3.8);
  scene.wall(3, 0, 3, 4, 3.1, 3.8).wall(3.3, 4, 3.3, 0, 3.1, 3.8).ceiling(3, 0, 3.3, 4, 3.1);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 24, 1e-3);
}

TEST(Reality, ARoomWithoutAScannedCeilingStaysBesideOneWithIt) {
  Scene scene;
  add_box(scene, 0, 0, 5, 4);
  add_box(scene, 5.12, 0, 9, 4, 0, 2.5, false);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_NEAR(layout.building.rooms[1].area, 15.52, 1e-3);
  EXPECT_NEAR(layout.building.rooms[1].height, 2.5, 0.06);
}

TEST(Reality, AColumnShowsItsFacesAndAStrayPairOfWallsIsNone) {
  const auto with = [](double bottom, double top) {
    Scene scene;
    add_box(scene, 0, 0, 6, 5);
    scene.wall(2.8, 2.3, 2.8, 2.7, bottom, top).wall(2.8, 2.7, 3.2, 2.7, bottom, top);
    scene.wall(3.2, 2.7, 3.2, 2.3, bottom, top).wall(3.2, 2.3, 2.8, 2.3, bottom, top);
    return laid_out(scene.planes());
  };
  EXPECT_NEAR(with(0, 2.5).building.rooms.at(0).area, 30 - 0.16, 1e-3);
  EXPECT_NEAR(with(0, 1.2).building.rooms.at(0).area, 30, 1e-3);
}

}  // namespace
}  // namespace atrium::layout::reality_test
