#include "modules/layout/mirror_images.hpp"

#include <gtest/gtest.h>

#include "tests/support/box_building.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::layout::mirror_images_test {
namespace {

/// Two rooms of 4 m × 3 m that meet at x = 4, the second half as densely scanned, with a table and a shelf in each:
/// in the second one where a mirror on the wall would show them, or moved by so much;
/// `wall`: the thickness of the wall between them.
PlanePrimitives furnished(double moved, double spacing = 0.04, double wall = 0) {
  atrium::test::Rooms scene;
  scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).floor(4 + wall, 0, 8 + wall, 3).ceiling(4 + wall, 0, 8 + wall, 3);
  const auto board = [&](double x, double y, double z, double wide, double deep) {
    for (double u = 0; u < wide; u += spacing)
      for (double v = 0; v < deep; v += spacing) {
        scene.stray({x + u, y + v, z});
        if (static_cast<int>(u / spacing) % 2 == 0) scene.stray({8 + wall - (x + u) - moved, y + v + moved, z});
      }
  };
  board(1, 1, 0.74, 1.4, 0.8);
  board(3, 0.3, 1.2, 0.4, 1.6);
  return scene.planes();
}

Building two_rooms(double wall = 0) {
  atrium::test::BoxBuilding b;
  b.room(0, 0, 4, 3, 0, 2.5);
  b.room(4 + wall, 0, 8 + wall, 3, 0, 2.5);
  return b.building;
}

TEST(MirrorImages, ARoomThatShowsAnotherOneMirroredIsItsImage) {
  const auto images = mirror_images(two_rooms(), furnished(0));
  ASSERT_EQ(images.size(), 1U);
  EXPECT_EQ(images[0].room, 1U);
  EXPECT_EQ(images[0].of, 0U);
  EXPECT_GT(images[0].share, 0.95);
}

TEST(MirrorImages, RoomsBuiltAsEachOthersImageAreFurnishedDifferently) {
  EXPECT_TRUE(mirror_images(two_rooms(), furnished(0.7)).empty());
}

TEST(MirrorImages, TwinsOnBothSidesOfAWallAreNoImages) {
  for (const double wall : {0.1, 0.2, 0.4})
    EXPECT_TRUE(mirror_images(two_rooms(wall), furnished(0, 0.04, wall)).empty()) << wall;
}

TEST(MirrorImages, RadiatorsAtTheWallsOfEmptyRoomsAreNoImage) {
  atrium::test::Rooms scene;
  scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).floor(4, 0, 8, 3).ceiling(4, 0, 8, 3);
  for (double u = 0; u < 2; u += 0.03)
    for (double z = 0.1; z < 0.8; z += 0.03) {
      scene.stray({1 + u, 0.12, z});
      if (z < 0.5) scene.stray({7 - u, 0.12, z});
    }
  EXPECT_TRUE(mirror_images(two_rooms(), scene.planes()).empty());
}

TEST(MirrorImages, StraysEverywhereAreNoImage) {
  Random random(3);
  atrium::test::Rooms scene;
  scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).floor(4, 0, 8, 3).ceiling(4, 0, 8, 3);
  for (int i = 0; i < 20000; ++i)
    scene.stray({random.uniform(0, i % 3 == 0 ? 8 : 4), random.uniform(0, 3), random.uniform(0, 2.5)});
  EXPECT_TRUE(mirror_images(two_rooms(), scene.planes()).empty());
}

TEST(MirrorImages, OfHardlyFurnishedRoomsNothingIsSaid) {
  EXPECT_TRUE(mirror_images(two_rooms(), furnished(0, 0.4)).empty());
  EXPECT_TRUE(mirror_images(Building{}, furnished(0)).empty());
}

}  // namespace
}  // namespace atrium::layout::mirror_images_test
