// What real scans show badly: furniture that covers a floor, beams under a ceiling, ends without a wall, slopes and
// panes.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/layout/confidence.hpp"
#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::as_scanned_test {
namespace {

using namespace atrium::test;
using Scene = atrium::test::Rooms;

/// A room of 6 x 5 x 2.6 m.
Scene large_room() {
  Scene scene;
  scene.floor(0, 0, 6, 5).ceiling(0, 0, 6, 5, 2.6).walls({{0, 0}, {6, 0}, {6, 5}, {0, 5}}, 0, 0, 2.6);
  return scene;
}
Structure storeys_of(const PlanePrimitives& planes, std::shared_ptr<Warnings> warnings = nullptr) {
  Context context(1, warnings ? std::move(warnings) : std::make_shared<Warnings>());
  return Storeys::run({input(planes)}, {}, context).structure;
}

TEST(AsScanned, TablesOverAFloorAreNoFloor) {
  Scene scene = large_room();
  scene.floor(0.5, 0.5, 5.5, 4.5, 0.6);  // wide, but the floor goes on under it
  const Structure structure = storeys_of(scene.unsorted());
  EXPECT_EQ(structure.classes.front(), SurfaceClass::floor);
  EXPECT_EQ(structure.classes.back(), SurfaceClass::object);
}

TEST(AsScanned, ARaisedFloorBesideTheOtherIsOne) {
  Scene scene;
  scene.floor(0, 0, 3, 5).floor(3, 0, 6, 5, 0.6).ceiling(0, 0, 6, 5, 2.9);
  scene.walls({{0, 0}, {6, 0}, {6, 5}, {0, 5}}, 0, 0, 2.9);
  const Structure structure = storeys_of(scene.unsorted());
  EXPECT_EQ(structure.classes[0], SurfaceClass::floor);
  EXPECT_EQ(structure.classes[1], SurfaceClass::floor);
}

TEST(AsScanned, TheTopOfABeamIsNoFloor) {
  Scene scene;
  scene.floor(1, 1, 4, 2, 2.3).ceiling(0, 0, 6, 5, 2.6).walls({{0, 0}, {6, 0}, {6, 5}, {0, 5}}, 0, 1, 2.6);
  const Structure structure = storeys_of(scene.unsorted());
  EXPECT_EQ(structure.classes[0], SurfaceClass::object);
  EXPECT_EQ(structure.classes[1], SurfaceClass::ceiling);
}

TEST(AsScanned, ARoomEndsWhereFloorAndCeilingDo) {
  Scene scene;  // open at x = 6
  scene.floor(0, 0, 6, 5).ceiling(0, 0, 6, 5, 2.6);
  scene.wall(0, 0, 6, 0, 0, 2.6).wall(6, 5, 0, 5, 0, 2.6).wall(0, 5, 0, 0, 0, 2.6);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 30, 0.6);
  EXPECT_EQ(flaw(layout), "");
}

TEST(AsScanned, ASlopeThatIsNoFaceIsADoubt) {
  Scene scene = large_room();
  const auto layout = laid_out(scene.planes());
  scene.add({1, 1, 0.3}, {4, 0, 0}, {0, 1.2, 1.8}, {0, -1.8, 1.2});  // sloping, in the middle of the room
  const auto warnings = std::make_shared<Warnings>();
  Context context(1, warnings);
  Structure structure;
  structure.primitives = std::make_shared<const PlanePrimitives>(scene.planes());
  const auto judged = Confidence::run({input(layout.building), input(structure), {}}, {}, context).building;
  EXPECT_TRUE(warnings->mention("sloping surfaces are no part of the model"));
  ASSERT_EQ(judged.doubts.size(), 2U);  // there is no door
  EXPECT_NEAR(std::stod(judged.doubts[0]), 8.65, 0.6);
  EXPECT_LT(judged.confidence, 1);
}

/// A room of 4 x 3 m with a hole in its first wall: of 1.4 x 1.2 m between points, or round. A shelf may stand before
/// it.
Layout room_with_gap(bool hidden, bool round = false) {
  Scene scene;
  scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).wall(4, 0, 4, 3).wall(4, 3, 0, 3).wall(0, 3, 0, 0);
  scene.add({0, 0, 0}, {4, 0, 0}, {0, 0, 2.5}, {0, 1, 0}, [&](const Eigen::Vector3d& p) {
    if (round) return std::hypot(p.x() - 1.9, p.z() - 1.4) > 0.7;
    return p.x() < 1.2 || p.x() > 2.5 || p.z() < 0.9 || p.z() > 2;
  });
  for (int i = 0; hidden && i < 20; ++i) scene.stray({1.3 + 0.05 * i, 0.3, 1.4});
  return laid_out(scene.planes());
}

TEST(AsScanned, ACleanGapInAnOuterWallIsAWindow) {
  const auto layout = room_with_gap(false);
  ASSERT_EQ(layout.building.openings.size(), 1U);
  const BuildingOpening& window = layout.building.openings[0];
  EXPECT_EQ(window.kind, "window");
  EXPECT_EQ(window.room_b, -1);
  Eigen::AlignedBox3d box;
  for (const auto& p : window.outline_a) box.extend(p);
  EXPECT_NEAR(box.sizes().x(), 1.4, 0.06);
  EXPECT_NEAR(box.sizes().z(), 1.2, 0.06);
  EXPECT_FALSE(layout.warnings->mention("gaps in walls"));
}

TEST(AsScanned, WhatStandsBeforeAGapHidesTheWall) {
  const auto layout = room_with_gap(true);
  EXPECT_TRUE(layout.building.openings.empty());
  EXPECT_FALSE(layout.warnings->mention("gaps in walls"));
}

TEST(AsScanned, ARoundGapIsNoWindow) { EXPECT_TRUE(room_with_gap(false, true).building.openings.empty()); }

}  // namespace
}  // namespace atrium::layout::as_scanned_test
