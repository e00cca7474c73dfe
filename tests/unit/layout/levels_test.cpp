// What tells floors from worktops and shelves: how wide a surface is, and whether one can stand on it.
#include <gtest/gtest.h>

#include "modules/layout/level_surfaces.hpp"
#include "modules/layout/raster.hpp"
#include "modules/layout/shelter.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::layout::levels_test {
namespace {

using Scene = atrium::test::Rooms;

Raster raster_of(const std::vector<Eigen::AlignedBox2d>& boxes) {
  constexpr double pixel = 0.05;
  std::vector<Eigen::Vector2d> points;
  for (const auto& box : boxes)
    for (double x = box.min().x() + pixel / 2; x < box.max().x(); x += pixel)
      for (double y = box.min().y() + pixel / 2; y < box.max().y(); y += pixel) points.emplace_back(x, y);
  return rasterize(points, pixel);
}

Eigen::AlignedBox2d box(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

TEST(Levels, AShelfAroundACornerIsNotWideAndAFloorIs) {
  EXPECT_TRUE(raster_of({box(0, 0, 2, 2)}).is_wide(1));
  EXPECT_FALSE(raster_of({box(0, 0, 4, 0.6)}).is_wide(1)) << "a worktop";
  EXPECT_FALSE(raster_of({box(0, 0, 4, 0.6), box(0, 0, 0.6, 3)}).is_wide(1)) << "one around a corner";
  EXPECT_TRUE(raster_of({box(0, 0, 4, 0.6), box(0, 0.6, 2, 2.6)}).is_wide(1)) << "a floor with a niche";
  EXPECT_FALSE(Raster{}.is_wide(1));
}

TEST(Levels, UnderALowCeilingNobodyStands) {
  const auto low = [](double ceiling, double x0, double x1) {
    Scene scene;
    scene.floor(0, 0, 4, 3).ceiling(x0, 0, x1, 3, ceiling);
    const PlanePrimitives planes = scene.planes();
    const auto footprints = layout::footprints(planes, 0.05, Context());
    const std::size_t floor = planes.primitives[0].plane.normal.z() > 0 ? 0 : 1;
    return Shelter(planes, footprints, 1.8).under_low_ceiling(floor);
  };
  EXPECT_GT(low(1.2, 0, 4), 0.95);
  EXPECT_NEAR(low(1.2, 0, 2), 0.5, 0.05) << "a half";
  EXPECT_LT(low(2.5, 0, 4), 0.05);
  EXPECT_LT(low(1.2, 0, 0.5), 0.05) << "a shelf of 1.5 m2 over it is no ceiling";
}

/// Heights of the floors of a room of 4 m × 3 m with a level surface at 0.5 m over a corner of it: of `deep` m by 2 m,
/// with walls (which stand on it) along as many of its sides as said.
std::vector<double> floors_with_platform(double deep, int walled) {
  Scene scene;
  scene.floor(0, 0, 4, 3, 0, [&](const Eigen::Vector3d& p) { return p.x() > 2 || p.y() > deep; });
  scene.ceiling(0, 0, 4, 3).floor(0, 0, 2, deep, 0.5);
  scene.wall(2, 0, 4, 0).wall(4, 0, 4, 3).wall(4, 3, 0, 3).wall(0, 3, 0, deep);
  scene.wall(0, deep, 0, 0).wall(0, 0, 2, 0);
  if (walled > 2) scene.wall(2, 0, 2, deep);
  if (walled > 3) scene.wall(2, deep, 0, deep);
  const PlanePrimitives planes = scene.planes();
  std::vector<double> heights;
  for (const auto& level : level_surfaces(planes, layout::footprints(planes, 0.05, Context()), 0.05, {}))
    if (level.up) heights.push_back(level.height);
  std::sort(heights.begin(), heights.end());
  return heights;
}

TEST(Levels, ABedInAnAlcoveIsNoFloorAndARaisedRoomIs) {
  EXPECT_EQ(floors_with_platform(1.8, 2).size(), 1U) << "a bed in a corner";
  EXPECT_EQ(floors_with_platform(1.8, 3).size(), 1U) << "a bed in an alcove";
  EXPECT_EQ(floors_with_platform(1.8, 4).size(), 2U) << "a raised room";
  EXPECT_EQ(floors_with_platform(2.8, 3).size(), 2U) << "larger than a bed, and open to one side";
}

}  // namespace
}  // namespace atrium::layout::levels_test
