// Which faces are the two sides of a wall: as far as their polygons lie over each other, not the boxes around them.
#include "modules/layout/wall_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atrium::layout::wall_pairs_test {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

/// A face over a polygon in x and y that is counter-clockwise from above, at a height, tilted about y; looking up or
/// down.
void add(Building& building, Corners corners, double height, bool up, double degrees = 0) {
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  if (!up) std::reverse(corners.begin(), corners.end());
  BuildingFace face;
  for (const auto& p : corners) {
    face.outline.push_back(static_cast<std::uint32_t>(building.vertices.size()));
    building.vertices.emplace_back(p.x(), p.y(), height + slope * p.x());
  }
  face.plane.normal = Eigen::Vector3d(-slope, 0, 1).normalized() * (up ? 1 : -1);
  face.plane.offset = -face.plane.normal.dot(building.vertices[face.outline[0]]);
  building.faces.push_back(face);
}

/// A ceiling at z = 0, and a floor above it.
std::vector<BuildingWall> pairs(const Corners& ceiling, const Corners& floor, double thickness, double degrees = 0) {
  Building building;
  add(building, ceiling, 0, false);
  add(building, floor, thickness, true, degrees);
  return wall_pairs(building, 0.6);
}

const Corners square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
const Corners corner{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};  // 7 m²
const Corners triangle{{0, 0}, {4, 0}, {0, 4}};                        // 8 m²

TEST(WallPairs, AreaIsThatOfWhatLiesOverEachOther) {
  for (const auto& [first, second, area] : std::vector<std::tuple<Corners, Corners, double>>{
           {square, square, 16}, {square, corner, 7}, {corner, square, 7}, {triangle, square, 8}}) {
    const auto walls = pairs(first, second, 0.3);
    ASSERT_EQ(walls.size(), 1U);
    EXPECT_NEAR(walls[0].area, area, 1e-6);
    EXPECT_NEAR(walls[0].thickness, 0.3, 1e-9);
    EXPECT_EQ(walls[0].face_a, 0);
    EXPECT_EQ(walls[0].face_b, 1);
  }
}

TEST(WallPairs, FacesBesideEachOtherAreNoneThoughTheirBoxesLieOverEachOther) {
  EXPECT_TRUE(pairs(corner, {{1, 1}, {4, 1}, {4, 4}, {1, 4}}, 0.3).empty());
}

TEST(WallPairs, HolesAreNotShared) {
  Building building;
  add(building, square, 0, false);
  add(building, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}, 0, true);
  building.faces[0].holes = {building.faces[1].outline};
  building.faces.pop_back();
  add(building, square, 0.3, true);
  add(building, {{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {1.5, 2.5}}, 0.3, true);
  const auto walls = wall_pairs(building, 0.6);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_NEAR(walls[0].area, 12, 1e-6);
}

TEST(WallPairs, ThicknessIsTheMeanOverTheSharedArea) {
  // The triangle's centroid is at x = 4/3, its box's middle at x = 2. The floor leans by 2°.
  const double slope = std::tan(2 * std::numbers::pi / 180);
  const auto walls = pairs(triangle, square, 0.3, 2);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_NEAR(walls[0].thickness, (0.3 + slope * 4 / 3) * std::cos(2 * std::numbers::pi / 180), 1e-6);
}

TEST(WallPairs, FacesOutOfParallelAreNone) { EXPECT_TRUE(pairs(square, square, 0.3, 4).empty()); }

TEST(WallPairs, FacesTooFarApartAreNone) {
  EXPECT_EQ(pairs(square, square, 0.55).size(), 1U);
  EXPECT_TRUE(pairs(square, square, 0.65).empty());
  EXPECT_TRUE(pairs(square, square, -0.3).empty());
}

}  // namespace
}  // namespace atrium::layout::wall_pairs_test
