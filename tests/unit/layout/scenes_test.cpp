// The layout nodes one after the other, on primitives that a perfect detection would give.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/types/cloud.hpp"
#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::scenes_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace atrium::test;
using Scene = atrium::test::Rooms;

std::vector<Vector2d> box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}
/// Walls, floor and ceiling of a box.
Scene& add_box(Scene& scene, double x0, double y0, double x1, double y1, double bottom = 0, double top = 2.5) {
  return scene.floor(x0, y0, x1, y1, bottom).ceiling(x0, y0, x1, y1, top).walls(box(x0, y0, x1, y1), 0, bottom, top);
}
std::vector<double> areas(const Building& building) {
  std::vector<double> result;
  for (const auto& room : building.rooms) result.push_back(room.area);
  return result;
}
std::size_t closed_parts(const Layout& layout) {
  return static_cast<std::size_t>(validity(layout.meshes.shell).at("validity.components.closed"));
}

TEST(Layout, ABoxIsABox) {
  const auto layout = laid_out(box_room().planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  const auto& room = layout.building.rooms[0];
  EXPECT_NEAR(room.area, 12, 1e-4);
  EXPECT_NEAR(room.volume, 30, 1e-3);
  EXPECT_NEAR(room.height, 2.5, 1e-5);
  EXPECT_EQ(room.faces.size(), 6U);
  EXPECT_EQ(layout.meshes.shell.triangles.size(), 12U);
  EXPECT_EQ(layout.meshes.structure.triangles.size(), 12U);
  EXPECT_TRUE(layout.building.openings.empty());
  for (const auto& face : layout.building.faces) {
    EXPECT_GT(face.observed, 0.95);
    EXPECT_GE(face.primitive, 0);
    EXPECT_LT(face.residual, 1e-4);
  }
  EXPECT_TRUE(layout.warnings->texts.empty());
}

TEST(Layout, AnLWhoseWallsEndBeforeTheCorners) {
  const auto layout = laid_out(l_room().planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 21, 1e-4);
  EXPECT_EQ(layout.building.rooms[0].faces.size(), 8U);
  EXPECT_EQ(layout.meshes.shell.triangles.size(), 20U);  // 4 n − 4
}

TEST(Layout, PlacesFarAwayAreTheSame) {
  const auto near = laid_out(l_room().planes());
  const auto far = laid_out(l_room().origin({5e5, 5.4e6, 300}).planes());
  EXPECT_EQ(far.building.origin, Vector3d(5e5, 5.4e6, 300));
  EXPECT_EQ(far.meshes.shell.origin, Vector3d(5e5, 5.4e6, 300));
  EXPECT_EQ(near.building.vertices, far.building.vertices);
}

TEST(Layout, WallsOfTwelveCentimetresPartRooms) {
  Scene scene;
  add_box(scene, 0, 0, 4, 3);
  add_box(scene, 4.12, 0, 7, 3);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_NEAR(layout.building.rooms[0].area, 12, 1e-3);  // the largest first
  EXPECT_NEAR(layout.building.rooms[1].area, 2.88 * 3, 1e-3);
  ASSERT_EQ(layout.building.walls.size(), 1U);
  EXPECT_NEAR(layout.building.walls[0].thickness, 0.12, 1e-6);
  EXPECT_NEAR(layout.building.walls[0].area, 7.5, 0.01);
  EXPECT_EQ(closed_parts(layout), 2U);
}

TEST(Layout, WallsWithoutThicknessPartRooms) {
  Scene scene;
  add_box(scene, 0, 0, 4, 3);
  add_box(scene, 4, 0, 7, 3);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_NEAR(layout.building.rooms[0].area, 12, 1e-3);
  EXPECT_NEAR(layout.building.rooms[1].area, 9, 1e-3);
}

TEST(Layout, ADoorJoinsTwoRooms) {
  Scene scene;
  for (const double x : {0.0, 4.12})
    scene.floor(x, 0, x + 4, 3).ceiling(x, 0, x + 4, 3).wall(x, 0, x + 4, 0).wall(x + 4, 3, x, 3);
  const auto no_door = [](const Vector3d& p) { return p.y() < 1 || p.y() > 1.9 || p.z() > 2; };
  scene.wall(0, 3, 0, 0).wall(8.12, 0, 8.12, 3);
  scene.add({4, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, {-1, 0, 0}, no_door);
  scene.add({4.12, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, {1, 0, 0}, no_door);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  ASSERT_EQ(layout.building.openings.size(), 1U);
  const auto& door = layout.building.openings[0];
  EXPECT_EQ(door.kind, "door");
  EXPECT_EQ(std::min(door.room_a, door.room_b), 0);
  EXPECT_EQ(std::max(door.room_a, door.room_b), 1);
  EXPECT_NEAR(door.thickness, 0.12, 1e-6);
  Eigen::AlignedBox3d place;
  for (const auto& p : door.outline_a) place.extend(p);
  EXPECT_NEAR(place.min().y(), 1, 0.051);  // the points' distance
  EXPECT_NEAR(place.max().y(), 1.9, 0.051);
  EXPECT_NEAR(place.min().z(), 0, 1e-3);
  EXPECT_NEAR(place.max().z(), 2, 0.051);
  // The panes are what the structure lacks.
  const auto area = [](const atrium::Mesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
      sum += (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm() / 2;
    return sum;
  };
  EXPECT_NEAR(area(layout.meshes.shell), area(layout.meshes.structure) + area(layout.meshes.openings), 1e-6);
  EXPECT_NEAR(area(layout.meshes.openings), 2 * place.sizes().y() * place.sizes().z(), 0.02);
}

TEST(Layout, StoreysLieOverEachOther) {
  for (int storeys = 1; storeys <= 3; ++storeys) {
    Scene scene;
    for (int s = 0; s < storeys; ++s) add_box(scene, 0, 0, 5, 4, 2.8 * s, 2.8 * s + 2.5);
    const auto layout = laid_out(scene.planes());
    EXPECT_EQ(flaw(layout), "") << storeys;
    ASSERT_EQ(layout.building.storeys.size(), static_cast<std::size_t>(storeys));
    ASSERT_EQ(layout.building.rooms.size(), static_cast<std::size_t>(storeys));
    for (int s = 0; s < storeys; ++s) {
      EXPECT_NEAR(layout.building.storeys[static_cast<std::size_t>(s)].elevation, 2.8 * s, 1e-5);
      EXPECT_NEAR(layout.building.storeys[static_cast<std::size_t>(s)].height, 2.5, 1e-5);
      EXPECT_NEAR(layout.building.rooms[static_cast<std::size_t>(s)].volume, 50, 1e-2);
    }
  }
}

// Two rooms with suspended ceilings under a slab that was seen over both and over the wall between them.
TEST(Layout, TheSlabOverSuspendedCeilingsIsNoCeiling) {
  for (const double spacing : {0.05, 0.12}) {
    Scene scene;
    scene.spacing = spacing;
    add_box(scene, 0, 0, 5, 4, 0, 2.7);
    add_box(scene, 5.12, 0, 9, 4, 0, 2.5);
    scene.ceiling(0, 0, 9, 4, 3.3);
    const auto layout = laid_out(scene.planes());
    ASSERT_EQ(layout.building.rooms.size(), 2U) << spacing;
    EXPECT_NEAR(layout.building.rooms[0].height, 2.7, 0.01) << spacing;
    EXPECT_NEAR(layout.building.rooms[1].height, 2.5, 0.01) << spacing;
  }
}

TEST(Layout, WallsThroughTwoStoreys) {
  Scene scene;
  for (int s = 0; s < 2; ++s) scene.floor(0, 0, 5, 4, 2.8 * s).ceiling(0, 0, 5, 4, 2.8 * s + 2.5);
  scene.walls(box(0, 0, 5, 4), 0, 0, 5.3);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  for (const auto& room : layout.building.rooms) EXPECT_NEAR(room.volume, 50, 1e-2);
}

TEST(Layout, AColumnInTheMiddleOfARoom) {
  Scene scene;
  const auto around = [](const Vector3d& p) { return p.x() < 2.5 || p.x() > 3.1 || p.y() < 2 || p.y() > 2.6; };
  scene.floor(0, 0, 6, 5, 0, around).ceiling(0, 0, 6, 5, 2.5, around).walls(box(0, 0, 6, 5));
  scene.walls({{2.5, 2}, {2.5, 2.6}, {3.1, 2.6}, {3.1, 2}});  // clockwise: seen from outside
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 30 - 0.36, 1e-3);
  EXPECT_NEAR(layout.building.rooms[0].volume, 2.5 * (30 - 0.36), 1e-2);
  ASSERT_EQ(layout.building.rooms[0].holes.size(), 1U);
  EXPECT_EQ(layout.building.rooms[0].holes[0].size(), 4U);
  EXPECT_EQ(layout.building.faces.size(), 10U);
  // Genus 1: vertices − edges + faces is 0 for triangles.
  const auto& mesh = layout.meshes.shell;
  EXPECT_EQ(static_cast<int>(mesh.vertices.size()) - static_cast<int>(mesh.triangles.size()) / 2, 0);
}

TEST(Layout, RoomsThatTouchInACorner) {
  Scene scene;
  add_box(scene, 0, 0, 3, 3);
  add_box(scene, 3, 3, 6, 6);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  for (const double area : areas(layout.building)) EXPECT_NEAR(area, 9, 1e-3);
}

TEST(Layout, WithoutACeilingWallsSayHowHighARoomIs) {
  Scene scene;
  scene.floor(0, 0, 5, 4).walls(box(0, 0, 5, 4));
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  EXPECT_TRUE(layout.warnings->mention("no ceiling"));
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 20, 1e-3);
  EXPECT_NEAR(layout.building.rooms[0].height, 2.5, 0.06);  // to the square
  for (const auto& face : layout.building.faces)
    if (face.surface == SurfaceClass::ceiling) {
      EXPECT_EQ(face.observed, 0);
      EXPECT_EQ(face.primitive, -1);
    }
}

TEST(Layout, WithoutAFloorWallsSayWhereItIs) {
  Scene scene;
  scene.ceiling(0, 0, 5, 4).walls(box(0, 0, 5, 4));
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  EXPECT_TRUE(layout.warnings->mention("no floor"));
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].area, 20, 1e-3);
  EXPECT_NEAR(layout.building.rooms[0].height, 2.5, 0.06);
}

TEST(Layout, AMissingWallIsInferred) {
  Scene scene;
  scene.floor(0, 0, 5, 4).ceiling(0, 0, 5, 4);
  scene.wall(0, 0, 5, 0).wall(5, 0, 5, 4).wall(0, 4, 0, 0);  // the one at y = 4 was not seen
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  // At most deeper by the margin around all points and a square.
  EXPECT_NEAR(layout.building.rooms[0].area, 20, 5 * 1.1);
}

TEST(Layout, AFloorAndACeilingWithoutWalls) {
  Scene scene;
  scene.floor(0, 0, 7, 7).ceiling(0, 0, 7, 7);
  const std::string error = error_of(scene.planes());
  if (!error.empty()) {
    EXPECT_NE(error.find("shows no room: nothing is inside (no wall found)"), std::string::npos) << error;
    return;
  }
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(std::sqrt(layout.building.rooms[0].area), 7, 2 * 1.1);
}

TEST(Layout, AnUpperStoreyWhoseFloorShowsInStripsOnly) {
  for (const double height : {0.0, 20.0, -20.0}) {
    Scene scene;
    add_box(scene, 0, 0, 5, 4, height, height + 2.5);
    scene.floor(0, 0, 5, 4, height + 2.8, [](const Vector3d& p) { return std::fmod(p.y(), 0.6) < 0.3; });
    scene.ceiling(0, 0, 5, 4, height + 5.3).walls(box(0, 0, 5, 4), 0, height + 2.8, height + 5.3);
    const auto layout = laid_out(scene.planes());
    EXPECT_EQ(flaw(layout), "") << height;
    ASSERT_EQ(layout.building.rooms.size(), 2U) << height;
    for (const auto& room : layout.building.rooms) EXPECT_NEAR(room.height, 2.5, 0.06) << height;
  }
}

TEST(Layout, WithoutACeilingEachRoomEndsWhereItsWallsDo) {
  Scene scene;
  scene.floor(0, 0, 4, 3).walls(box(0, 0, 4, 3), 0, 0, 2.6);
  scene.floor(4.12, 0, 7, 3).walls(box(4.12, 0, 7, 3), 0, 0, 2.3);
  // A board on the wall, seen from below, is no ceiling; nor is what hides the top of a wall.
  scene.ceiling(0, 0, 1, 0.6, 1.9);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_NEAR(layout.building.rooms[0].height, 2.6, 0.02);
  EXPECT_NEAR(layout.building.rooms[1].height, 2.3, 0.02);
  for (const auto& face : layout.building.faces)
    EXPECT_TRUE(face.surface != SurfaceClass::ceiling || face.primitive == -1);
}

TEST(Layout, ARoomWhoseCeilingWasSeenKeepsItBesideOneWhereItWasNot) {
  Scene scene;
  scene.floor(0, 0, 4, 3).walls(box(0, 0, 4, 3), 0, 0, 2.6).ceiling(0, 0, 4, 3, 2.6);
  scene.floor(4.12, 0, 7, 3).walls(box(4.12, 0, 7, 3), 0, 0, 2.45);
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_NEAR(layout.building.rooms[0].height, 2.6, 1e-4);
  EXPECT_NEAR(layout.building.rooms[1].height, 2.45, 0.02);
}

TEST(Layout, ARampIsAFloor) {
  Scene scene;
  scene.add({0, 0, 0}, {4, 0, 0.2}, {0, 3, 0}, {-0.05, 0, 1}).ceiling(0, 0, 4, 3).walls(box(0, 0, 4, 3));
  const auto layout = laid_out(scene.planes());
  EXPECT_EQ(flaw(layout), "");
  ASSERT_EQ(layout.building.rooms.size(), 1U);
  EXPECT_NEAR(layout.building.rooms[0].volume, 12 * 2.4, 1e-2);
}

TEST(Layout, RoomsOfTwoLevelsBesideEachOther) {
  // The floor of the second lies below the first one's ceiling, and above it.
  for (const double step : {1.2, 2.8}) {
    Scene scene;
    add_box(scene, 0, 0, 4, 3);
    add_box(scene, 4.12, 0, 8, 3, step, step + 2.5);
    const auto layout = laid_out(scene.planes());
    EXPECT_EQ(flaw(layout), "") << step;
    ASSERT_EQ(layout.building.rooms.size(), 2U) << step;
    for (const auto& room : layout.building.rooms) EXPECT_NEAR(room.height, 2.5, 1e-3) << step;
  }
}

TEST(Layout, PlanesKilometresApartAreRefused) {
  const auto refused = [](const PlanePrimitives& planes) {
    const std::string error = error_of(planes);
    return error.find("m apart") != std::string::npos && error.find("too far") != std::string::npos;
  };
  // A facade far from all floors and ceilings is left out.
  Scene scene = box_room();
  scene.wall(3000, 2000, 3008, 2000);
  EXPECT_EQ(laid_out(scene.planes()).building.vertices, laid_out(box_room().planes()).building.vertices);
  // One plane of two far pieces.
  PlanePrimitives planes = Scene().floor(0, 0, 4, 3).floor(9000, 9000, 9004, 9003).walls(box(0, 0, 4, 3)).unsorted();
  auto& floor = planes.primitives[0].inliers;
  floor.insert(floor.end(), planes.primitives[1].inliers.begin(), planes.primitives[1].inliers.end());
  planes.primitives.erase(planes.primitives.begin() + 1);
  EXPECT_TRUE(refused(planes));
}

TEST(Layout, WhatShowsNoRoomHasADefinedAnswer) {
  const auto level = [](const std::string& text) { return text.find("level") != std::string::npos; };
  EXPECT_TRUE(level(error_of(PlanePrimitives{})));
  EXPECT_TRUE(level(error_of(Scene().walls(box(0, 0, 5, 4)).planes())));
  EXPECT_TRUE(level(error_of(Scene().wall(0, 0, 5, 0).planes())));
  EXPECT_NE(error_of(Scene().floor(0, 0, 5, 4).planes()), "");
  EXPECT_NE(error_of(Scene().ceiling(0, 0, 5, 4).planes()), "");
  // One wall over a floor encloses nothing.
  EXPECT_NE(error_of(Scene().floor(0, 0, 5, 4).wall(0, 0, 5, 0).planes()), "");
}

TEST(Layout, PrimitivesWithoutPointsAndDuplicatePointsDoNotMatter) {
  PlanePrimitives planes = box_room().planes();
  const auto before = laid_out(planes).building;
  planes.primitives.push_back({{{0, 1, 0}, -1.5}, {}, 0});
  planes.primitives.push_back({{{0, 0, 1}, -1}, {}, 0});
  EXPECT_EQ(laid_out(planes).building.vertices, before.vertices);
  // Each point twice.
  planes = box_room().planes();
  Cloud cloud = *planes.cloud;
  const auto n = static_cast<std::uint32_t>(cloud.points.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    cloud.points.push_back(cloud.points[i]);
    cloud.normals.push_back(cloud.normals[i]);
  }
  for (auto& primitive : planes.primitives) {
    const std::size_t size = primitive.inliers.size();
    for (std::size_t i = 0; i < size; ++i) primitive.inliers.push_back(primitive.inliers[i] + n);
  }
  planes.cloud = std::make_shared<const Cloud>(cloud);
  EXPECT_EQ(laid_out(planes).building.vertices, before.vertices);
}

TEST(Layout, TheOrderOfPrimitivesDoesNotMatter) {
  PlanePrimitives planes = l_room().planes();
  auto before = laid_out(planes).building.vertices;
  std::reverse(planes.primitives.begin(), planes.primitives.end());
  auto after = laid_out(planes).building.vertices;
  const auto less = [](const Vector3d& a, const Vector3d& b) {
    return std::tuple(std::lround(a.x() * 1e4), std::lround(a.y() * 1e4), std::lround(a.z() * 1e4)) <
           std::tuple(std::lround(b.x() * 1e4), std::lround(b.y() * 1e4), std::lround(b.z() * 1e4));
  };
  std::sort(before.begin(), before.end(), less);
  std::sort(after.begin(), after.end(), less);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT((before[i] - after[i]).norm(), 1e-6);
}

}  // namespace
}  // namespace atrium::layout::scenes_test
