// Doors and windows of exact rooms: what furniture, the other side of a wall, reveals and scanner places say of them.
#include "modules/layout/openings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "modules/types/building_rules.hpp"
#include "tests/unit/layout/rooms_with_holes.hpp"

namespace atrium::layout::openings_test {
namespace {

/// The same with scanner places; all points are of the first one that lies in the same half (x below or above
/// `border`).
PlanePrimitives seen_from(const PlanePrimitives& planes, const std::vector<Vector3d>& places, double border = 1e9) {
  PlanePrimitives result = planes;
  Cloud cloud = *planes.cloud;
  for (const auto& place : places) cloud.sensors.emplace_back(place.cast<float>());
  for (const auto& p : cloud.points) cloud.source.push_back(places.size() > 1 && p.x() > border ? 1 : 0);
  result.cloud = std::make_shared<const Cloud>(cloud);
  return result;
}

const AlignedBox2d window(Vector2d(1.2, 0.9), Vector2d(2.5, 2.0));

TEST(Openings, AWindowWithItsReveal) {
  Scene scene = room_with(window);
  add_reveal(scene, window);
  for (const auto& planes : {scene.planes(), seen_from(scene.planes(), {{2, 2, 1.5}, {3, 1, 1.5}})}) {
    const auto layout = laid_out(planes);
    ASSERT_EQ(layout.building.openings.size(), 1U);
    const auto& opening = layout.building.openings[0];
    EXPECT_EQ(opening.kind, "window");
    EXPECT_EQ(opening.face_b, -1);
    EXPECT_EQ(opening.room_b, -1);
    EXPECT_LT((place_of(opening).min() - window.min()).cwiseAbs().maxCoeff(), 0.03);
    EXPECT_LT((place_of(opening).max() - window.max()).cwiseAbs().maxCoeff(), 0.03);
  }
}

TEST(Openings, BehindAHoleDownToTheFloorSomethingMustShow) {
  const AlignedBox2d hole(Vector2d(1.5, 0), Vector2d(2.4, 2.05));
  EXPECT_TRUE(laid_out(room_with(hole).planes()).building.openings.empty());
}

TEST(Openings, SparsePointsLeaveNoHolesButTheWindow) {
  Scene scene = room_with(window, 0.14);
  add_reveal(scene, window);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.openings.size(), 1U);
  // The reveal is dense enough to say where its sides are.
  EXPECT_LT((place_of(layout.building.openings[0]).min() - window.min()).cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT((place_of(layout.building.openings[0]).max() - window.max()).cwiseAbs().maxCoeff(), 0.03);
}

TEST(Openings, AWardrobeHidesTheWallAndIsNoOpening) {
  const AlignedBox2d hidden(Vector2d(1, 0), Vector2d(2.6, 2.1));
  Scene scene = room_with(hidden);
  // Its front and sides; the wall behind it shows nowhere, and a few points lie beyond.
  scatter(scene, {1, 0.6, 0}, {1.6, 0, 0}, {0, 0, 2.1});
  scatter(scene, {1, 0, 0}, {0, 0.6, 0}, {0, 0, 2.1});
  scatter(scene, {2.6, 0, 0}, {0, 0.6, 0}, {0, 0, 2.1});
  scatter(scene, {1, 0, 2.1}, {1.6, 0, 0}, {0, 0.6, 0});
  for (const double x : {1.2, 1.5, 1.9, 2.3}) scene.stray({x, -0.3, 1.1});
  EXPECT_TRUE(laid_out(scene.planes()).building.openings.empty());
  EXPECT_TRUE(laid_out(seen_from(scene.planes(), {{2, 2, 1.5}, {3, 1.5, 1.5}})).building.openings.empty());
}

TEST(Openings, AHoleDownToTheFloorIsADoorByItsLeafOrItsSize) {
  for (const bool leaf : {true, false})
    for (const double width : {0.9, 1.8}) {
      const AlignedBox2d hole(Vector2d(1.5, 0), Vector2d(1.5 + width, 2.05));
      Scene scene = room_with(hole);
      add_reveal(scene, hole);
      if (leaf) scatter(scene, {1.5, -0.25, 0}, {width, 0, 0}, {0, 0, 2.05});
      const auto layout = laid_out(scene.planes());
      ASSERT_EQ(layout.building.openings.size(), 1U) << leaf << width;
      EXPECT_EQ(layout.building.openings[0].kind, "door") << leaf << width;
      EXPECT_EQ(layout.warnings->mention("neither a leaf nor a floor"), !leaf) << leaf << width;
      EXPECT_NEAR(place_of(layout.building.openings[0]).min().y(), 0, 1e-3);
      EXPECT_NEAR(place_of(layout.building.openings[0]).max().y(), 2.05, 0.03);
    }
}

TEST(Openings, GlassDownToTheFloorIsTheDoorOfARoomWithoutAnother) {
  const AlignedBox2d glass(Vector2d(1.5, 0), Vector2d(3.3, 2.05)), way(Vector2d(0.9, 0), Vector2d(1.8, 2.05));
  for (const bool other : {true, false}) {
    Scene scene;
    scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).wall(4, 0, 4, 3).wall(0, 3, 0, 0);
    scene.add({0, 0, 0}, {4, 0, 0}, {0, 0, 2.5}, {0, 1, 0}, without({0, 0, 0}, {1, 0, 0}, glass));
    add_reveal(scene, glass);
    scene.add({4, 3, 0}, {-4, 0, 0}, {0, 0, 2.5}, {0, -1, 0},
              without({4, 3, 0}, {-1, 0, 0}, other ? way : AlignedBox2d()));
    if (other) scatter(scene, {2.2, 3.2, 0}, {0.9, 0, 0}, {0, 0, 2.05});  // its leaf
    const auto layout = laid_out(scene.planes());
    EXPECT_EQ(std::count_if(layout.building.openings.begin(), layout.building.openings.end(),
                            [](const auto& opening) { return opening.kind == "door"; }),
              1);
    EXPECT_TRUE(layout.warnings->mention(other ? "0 are taken for doors, 1 for windows" : "1 are taken for doors, 0"));
  }
}

TEST(Openings, AWindowWhoseWallIsHiddenBelowMayBeADoor) {
  for (const double top : {1.7, 2.05}) {
    const AlignedBox2d hole(Vector2d(1.5, 0), Vector2d(2.4, top));
    Scene scene = room_with(hole);
    add_reveal(scene, {Vector2d(1.5, 0.5), Vector2d(2.4, top)});
    scatter(scene, {0.8, 0.3, 0}, {2.3, 0, 0}, {0, 0, 0.5});  // a sofa
    scatter(scene, {0.8, 0.05, 0.5}, {2.3, 0, 0}, {0, 0.25, 0});
    const auto layout = laid_out(scene.planes());
    ASSERT_EQ(layout.building.openings.size(), 1U) << top;
    // No other door leads into the room.
    EXPECT_EQ(layout.building.openings[0].kind, top > 2 ? "door" : "window") << top;
    EXPECT_EQ(layout.warnings->mention("are taken for doors, as no other leads into their rooms: 1"), top > 2) << top;
  }
}

TEST(Openings, AFloorThatLiesALittleLowerIsAWayOut) {
  for (const double floor : {0.0, -0.1, -0.4}) {
    const AlignedBox2d hole(Vector2d(0.8, 0), Vector2d(3.1, 2.05));
    Scene scene = room_with(hole);
    add_reveal(scene, hole);
    scatter(scene, {0.5, -2, floor}, {3, 0, 0}, {0, 1.7, 0});
    const auto layout = laid_out(scene.planes());
    ASSERT_EQ(layout.building.openings.size(), 1U) << floor;
    EXPECT_EQ(layout.building.openings[0].kind, floor > -0.2 ? "passage" : "window") << floor;
  }
}

TEST(Openings, ALowHoleAtTheFloorOfAnOuterWallThatShowsNothingIsLeftClosed) {
  for (const Vector2d& size : {Vector2d(0.65, 0.7), Vector2d(0.9, 1.3)}) {
    const AlignedBox2d hole(Vector2d(1.5, 0), Vector2d(1.5 + size.x(), size.y()));
    Scene scene = room_with(hole);
    add_reveal(scene, hole);
    const auto layout = laid_out(scene.planes());
    EXPECT_TRUE(layout.building.openings.empty()) << size.transpose();
    EXPECT_TRUE(layout.warnings->mention("holes in walls down to a floor are left closed")) << size.transpose();
  }
}

TEST(Openings, ADoorBesideACornerIsFound) {
  const AlignedBox2d hole(Vector2d(0.05, 0), Vector2d(0.75, 2));
  Scene scene = room_with(hole);
  add_reveal(scene, hole);
  scatter(scene, {0.05, -0.25, 0}, {0.7, 0, 0}, {0, 0, 2});
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.openings.size(), 1U);
  EXPECT_EQ(layout.building.openings[0].kind, "door");
  EXPECT_NEAR(place_of(layout.building.openings[0]).min().x(), 0.05, 0.055);  // no wall is left there
  EXPECT_NEAR(place_of(layout.building.openings[0]).max().x(), 0.75, 0.03);
}

/// Two rooms beside each other, the wall between them 12 cm thick, its two faces with holes in y and z.
Scene two_rooms(const AlignedBox2d& west, const AlignedBox2d& east) {
  Scene scene;
  for (const double x : {0.0, 4.12})
    scene.floor(x, 0, x + 4, 3).ceiling(x, 0, x + 4, 3).wall(x, 0, x + 4, 0).wall(x + 4, 3, x, 3);
  scene.wall(0, 3, 0, 0).wall(8.12, 0, 8.12, 3);
  scene.add({4, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, {-1, 0, 0}, without({4, 0, 0}, {0, 1, 0}, west));
  scene.add({4.12, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, {1, 0, 0}, without({4.12, 0, 0}, {0, 1, 0}, east));
  return scene;
}
const AlignedBox2d door(Vector2d(1, 0), Vector2d(1.9, 2));
const std::vector<Vector3d> in_both{{2, 1.4, 1.5}, {6, 1.4, 1.5}};

TEST(Openings, WhatTheOtherSideOfTheWallShowsIsNoHole) {
  // A niche: the face lacks points and its back is seen, but the other room's face is whole, and too much of the wall
  // is left for a leaf.
  Scene scene = two_rooms(door, {});
  scatter(scene, {4.04, 1, 0}, {0, 0.9, 0}, {0, 0, 2});
  const auto layout = laid_out(scene.planes());
  EXPECT_TRUE(layout.building.openings.empty());
  EXPECT_TRUE(layout.warnings->mention("what may be closed doors"));
  EXPECT_TRUE(laid_out(seen_from(scene.planes(), in_both, 4.06)).building.openings.empty());
}

/// Two rooms with the same hole in the wall between them, of whose reveal the sides and the top were seen.
Scene joined_rooms(const AlignedBox2d& hole) {
  Scene scene = two_rooms(hole, hole);
  const double width = hole.sizes().x(), height = hole.max().y();
  for (const double y : {hole.min().x(), hole.max().x()}) scatter(scene, {4, y, 0}, {0, 0, height}, {0.12, 0, 0});
  scatter(scene, {4, hole.min().x(), height}, {0, width, 0}, {0.12, 0, 0});
  return scene;
}

TEST(Openings, ALowHoleAtTheFloorIsNoDoorOrADoubt) {
  EXPECT_FALSE(laid_out(joined_rooms(door).planes()).warnings->mention("lower than"));
  const auto low = laid_out(joined_rooms({Vector2d(1, 0), Vector2d(1.9, 1.2)}).planes());
  EXPECT_EQ(low.building.openings.size(), 1U);
  EXPECT_TRUE(low.warnings->mention("1 door is lower than 1.50 m, the lowest 1.20 m"));
  for (const Vector2d& size : {Vector2d(0.5, 1.2), Vector2d(0.9, 0.8)}) {
    const auto none = laid_out(joined_rooms({Vector2d(1, 0), Vector2d(1 + size.x(), size.y())}).planes());
    EXPECT_TRUE(none.building.openings.empty());
    EXPECT_TRUE(none.warnings->mention("holes in walls down to a floor are left closed"));
  }
}

TEST(Openings, ADoorWhoseFootIsHiddenReachesTheFloor) {
  // A chest stands before it on both sides.
  Scene scene = two_rooms(door, door);
  for (const double x : {3.6, 4.52}) scatter(scene, {x, 0.8, 0}, {0, 1.3, 0}, {0, 0, 0.8});
  for (const double x : {3.6, 4.12}) scatter(scene, {x, 0.8, 0.8}, {0, 1.3, 0}, {0.4, 0, 0});
  scatter(scene, {4, 1, 0.8}, {0, 0, 1.2}, {0.12, 0, 0});
  scatter(scene, {4, 1.9, 0.8}, {0, 0, 1.2}, {0.12, 0, 0});
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.openings.size(), 1U);
  EXPECT_EQ(layout.building.openings[0].kind, "door");
  EXPECT_NEAR(layout.building.openings[0].thickness, 0.12, 1e-6);
  EXPECT_NEAR(place_of(layout.building.openings[0]).min().y(), 0, 1e-3);
  EXPECT_NE(layout.building.openings[0].room_a, layout.building.openings[0].room_b);
}

TEST(Openings, AScannerInTheStoreyAboveSeesNothingBelow) {
  // Only the upper room holds a scanner place: the lower one is looked at from made-up places.
  Scene scene = room_with(window);
  add_reveal(scene, window);
  scene.floor(0, 0, 4, 3, 2.8).ceiling(0, 0, 4, 3, 5.3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 0, 2.8, 5.3);
  const auto layout = laid_out(seen_from(scene.planes(), {{2, 1.5, 4.3}}));
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_EQ(layout.building.openings.size(), 1U);
}

/// The openings of a building whose places are the same, but written relative to another origin.
std::vector<BuildingOpening> openings_of(const Layout& layout, const Building& building) {
  Context context;
  return Openings::run({input(building), input(layout.structure)}, {}, context).building.openings;
}

TEST(Openings, TheBuildingMayHaveAnotherOriginThanTheCloud) {
  Scene scene = two_rooms(door, door);
  scatter(scene, {4, 1, 0}, {0, 0, 2}, {0.12, 0, 0});
  scatter(scene, {4, 1.9, 0}, {0, 0, 2}, {0.12, 0, 0});
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.openings.size(), 1U);
  const Vector3d shift(100, -40, 8);
  const auto openings = openings_of(layout, with_origin(layout.building, layout.building.origin + shift));
  ASSERT_EQ(openings.size(), 1U);
  const auto &here = openings[0], &there = layout.building.openings[0];
  EXPECT_EQ(here.kind, there.kind);
  EXPECT_NEAR(here.thickness, there.thickness, 1e-9);
  ASSERT_EQ(here.outline_b.size(), there.outline_b.size());
  for (std::size_t i = 0; i < here.outline_b.size(); ++i) {
    EXPECT_LT((here.outline_a[i] + shift - there.outline_a[i]).norm(), 1e-9);
    EXPECT_LT((here.outline_b[i] + shift - there.outline_b[i]).norm(), 1e-9);
  }
}

TEST(Openings, FacesOfNoRoomHaveNone) {
  Scene scene = room_with(window);
  add_reveal(scene, window);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.openings.size(), 1U);
  Building building = layout.building;
  building.faces[static_cast<std::size_t>(building.openings[0].face_a)].room = -1;
  EXPECT_TRUE(openings_of(layout, building).empty());
}

TEST(Openings, BrokenBuildingsAreErrors) {
  const auto layout = laid_out(room_with(window).planes());
  Building building = layout.building;
  building.faces[1].room = 7;
  EXPECT_THROW(openings_of(layout, building), Error);
  building = layout.building;
  building.faces[2].outline[0] = 1000;
  EXPECT_THROW(openings_of(layout, building), Error);
}

}  // namespace
}  // namespace atrium::layout::openings_test
