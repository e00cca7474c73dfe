// Closed doors and blinds, which only the step of their leaf shows.
#include "modules/layout/closed_leaves.hpp"

#include <gtest/gtest.h>

#include "tests/unit/layout/rooms_with_holes.hpp"

namespace atrium::layout::closed_leaves_test {
namespace {

using namespace openings_test;

/// A room whose wall at y = 0 has a rectangle that stands `depth` behind it (below 0: before it), with its sides.
Scene room_with_leaf(const AlignedBox2d& leaf, double depth, bool sides, double noise = 0, double spacing = 0.025) {
  Scene scene;
  scene.spacing = spacing;
  scene.noise = noise;
  scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).wall(4, 0, 4, 3).wall(4, 3, 0, 3).wall(0, 3, 0, 0);
  scene.add({0, 0, 0}, {4, 0, 0}, {0, 0, 2.5}, {0, 1, 0}, without({0, 0, 0}, {1, 0, 0}, leaf));
  const Vector3d low(leaf.min().x(), 0, leaf.min().y()), across(leaf.sizes().x(), 0, 0), up(0, 0, leaf.sizes().y());
  Random random(2);
  const int width = static_cast<int>(leaf.sizes().x() / spacing), height = static_cast<int>(leaf.sizes().y() / spacing);
  for (int i = 1; i < width; ++i)
    for (int k = 1; k < height; ++k)
      scene.stray(low + Vector3d(i * spacing, noise * random.normal() - depth, k * spacing));
  if (!sides) return scene;
  const Vector3d back(0, -depth, 0);
  scatter(scene, low, up, back, 0.02);
  scatter(scene, low + across, up, back, 0.02);
  scatter(scene, low + up, across, back, 0.02);
  if (low.z() > 0) scatter(scene, low, across, back, 0.02);
  return scene;
}

TEST(ClosedLeaves, AClosedDoorIsFoundByTheStepOfItsLeaf) {
  const AlignedBox2d leaf(Vector2d(1.5, 0), Vector2d(2.4, 2.05));
  for (const double depth : {0.04, 0.06, 0.10, -0.03})
    for (const bool sides : {true, false})
      for (const double noise : {0.0, 0.005}) {
        const auto layout = laid_out(room_with_leaf(leaf, depth, sides, noise).planes());
        ASSERT_EQ(layout.building.openings.size(), 1U) << depth << sides << noise;
        EXPECT_EQ(layout.building.openings[0].kind, "door") << depth << sides << noise;
        const AlignedBox2d found = place_of(layout.building.openings[0]);
        EXPECT_LT((found.min() - leaf.min()).cwiseAbs().maxCoeff(), 0.03) << depth << sides << noise;
        EXPECT_LT((found.max() - leaf.max()).cwiseAbs().maxCoeff(), 0.03) << depth << sides << noise;
      }
}

TEST(ClosedLeaves, ACasingAroundAClosedDoorIsNoPartOfTheWall) {
  const AlignedBox2d leaf(Vector2d(1.5, 0), Vector2d(2.4, 2.05));
  Scene scene = room_with_leaf(leaf, 0.05, true, 0.003);
  for (const double x : {1.42, 2.4}) scatter(scene, {x, 0.02, 0}, {0.08, 0, 0}, {0, 0, 2.13}, 0.01);
  scatter(scene, {1.42, 0.02, 2.05}, {1.06, 0, 0}, {0, 0, 0.08}, 0.01);
  const auto layout = laid_out(scene.planes());
  ASSERT_EQ(layout.building.openings.size(), 1U);
  EXPECT_EQ(layout.building.openings[0].kind, "door");
}

/// Two rooms with a wall of 12 cm; a rectangle of a door's size stands `depth` behind the first one's face, and the
/// second one's face is whole.
Scene flush_on_the_other_side(double depth) {
  Scene scene = room_with_leaf({Vector2d(1.5, 0), Vector2d(2.4, 2.05)}, depth, true, 0.002);
  scene.floor(0, -3.12, 4, -0.12).ceiling(0, -3.12, 4, -0.12);
  return scene.walls({{0, -3.12}, {4, -3.12}, {4, -0.12}, {0, -0.12}});
}

TEST(ClosedLeaves, ALeafThatIsFlushWithTheOtherSideIsADoorAndANicheIsNot) {
  const auto doors = [](const Scene& scene) {
    const auto layout = laid_out(scene.planes());
    return std::count_if(layout.building.openings.begin(), layout.building.openings.end(),
                         [](const auto& opening) { return opening.kind == "door"; });
  };
  EXPECT_EQ(doors(flush_on_the_other_side(0.08)), 1);
  EXPECT_EQ(doors(flush_on_the_other_side(0.04)), 0);
}

TEST(ClosedLeaves, AClosedDoorOfTwoLeavesAndOneBesideACorner) {
  for (const auto& leaf :
       {AlignedBox2d(Vector2d(1, 0), Vector2d(2.8, 2.1)), AlignedBox2d(Vector2d(0.05, 0), Vector2d(0.95, 2.05))}) {
    const auto layout = laid_out(room_with_leaf(leaf, 0.05, true, 0.003).planes());
    ASSERT_EQ(layout.building.openings.size(), 1U) << leaf.min().x();
    EXPECT_EQ(layout.building.openings[0].kind, "door");
    EXPECT_LT((place_of(layout.building.openings[0]).max() - leaf.max()).cwiseAbs().maxCoeff(), 0.03);
  }
}

TEST(ClosedLeaves, ABlindBehindItsWallIsAWindow) {
  const AlignedBox2d blind(Vector2d(1.2, 0.9), Vector2d(2.5, 2.0));
  for (const double noise : {0.0, 0.005}) {
    const auto layout = laid_out(room_with_leaf(blind, 0.04, true, noise).planes());
    ASSERT_EQ(layout.building.openings.size(), 1U) << noise;
    EXPECT_EQ(layout.building.openings[0].kind, "window");
    EXPECT_LT((place_of(layout.building.openings[0]).min() - blind.min()).cwiseAbs().maxCoeff(), 0.03);
    EXPECT_TRUE(layout.warnings->mention("windows seen as a step in their wall alone"));
  }
}

TEST(ClosedLeaves, NichesPanelsAndCupboardsAreNoDoors) {
  const Vector2d foot(1.5, 0);
  const auto doors = [](const Scene& scene) {
    const auto layout = laid_out(scene.planes());
    return std::count_if(layout.building.openings.begin(), layout.building.openings.end(),
                         [](const auto& opening) { return opening.kind == "door"; });
  };
  for (const double noise : {0.0, 0.005}) {
    EXPECT_EQ(doors(room_with_leaf({Vector2d(1.5, 0.5), Vector2d(2.4, 2.1)}, 0.04, true, noise)), 0) << "a niche";
    EXPECT_EQ(doors(room_with_leaf({foot, Vector2d(2.4, 1.2)}, 0.04, true, noise)), 0) << "a low niche";
    EXPECT_EQ(doors(room_with_leaf({foot, Vector2d(2.4, 2.5)}, 0.04, true, noise)), 0) << "a niche up to the ceiling";
    EXPECT_EQ(doors(room_with_leaf({foot, Vector2d(1.9, 2.05)}, 0.04, true, noise)), 0) << "a slot";
    EXPECT_EQ(doors(room_with_leaf({Vector2d(1, 0), Vector2d(3.6, 2.05)}, 0.04, true, noise)), 0) << "panels";
    EXPECT_EQ(doors(room_with_leaf({foot, Vector2d(2.4, 2.05)}, -0.1, true, noise)), 0) << "a cupboard";
    EXPECT_EQ(doors(room_with_leaf({foot, Vector2d(2.4, 2.05)}, 0.01, true, noise)), 0) << "paint";
    EXPECT_EQ(doors(room_with_leaf({Vector2d(1.5, 0.8), Vector2d(2.4, 2.0)}, -0.03, true, noise)), 0) << "a picture";
  }
}

}  // namespace
}  // namespace atrium::layout::closed_leaves_test
