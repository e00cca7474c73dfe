// What tells a window from a door where something stands before the wall below it, and doors without a reveal.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::sills_test {
namespace {

using atrium::test::laid_out;
using Scene = atrium::test::Rooms;

/// Points of no primitive over a rectangle.
void scatter(Scene& scene, const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr double spacing = 0.025;
  const int na = static_cast<int>(a.norm() / spacing), nb = static_cast<int>(b.norm() / spacing);
  for (int i = 0; i <= na; ++i)
    for (int j = 0; j <= nb; ++j) scene.stray(corner + a * (1.0 * i / na) + b * (1.0 * j / nb));
}

/// A box room of 4 m × 3 m × 2.5 m; of its wall at y = 0 `seen` says which points there are.
Scene room_with(const std::function<bool(double x, double z)>& seen) {
  Scene scene;
  scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).wall(4, 0, 4, 3).wall(4, 3, 0, 3).wall(0, 3, 0, 0);
  scene.add({0, 0, 0}, {4, 0, 0}, {0, 0, 2.5}, {0, 1, 0}, [=](const Eigen::Vector3d& p) { return seen(p.x(), p.z()); });
  return scene;
}

/// A window of 1.3 m × 1.1 m with its reveal and frame, over a radiator that hides the wall up to `hidden`.
std::vector<BuildingOpening> over_a_radiator(double hidden) {
  Scene scene = room_with([=](double x, double z) {
    const bool beside = x <= 1.2 || x >= 2.5;
    return beside || z >= 2.0 || (z <= 0.9 && z >= hidden);
  });
  const Eigen::Vector3d depth(0, -0.25, 0), across(1.3, 0, 0), up(0, 0, 1.1), low(1.2, 0, 0.9);
  scatter(scene, low, up, depth);
  scatter(scene, low + across, up, depth);
  scatter(scene, low + up, across, depth);
  scatter(scene, low, across, depth);
  scatter(scene, {1.2, -0.1, 0.9}, across, up);  // shutters
  scatter(scene, {1.25, 0.1, 0.1}, {1.2, 0, 0}, {0, 0, 0.6});
  return laid_out(scene.planes()).building.openings;
}

TEST(Sills, AWindowOverARadiatorIsNoDoor) {
  const auto openings = over_a_radiator(0.7);
  ASSERT_EQ(openings.size(), 1U);
  EXPECT_EQ(openings[0].kind, "window");
}

TEST(Sills, WithoutAnyWallBelowItAShutteredHoleMayBeADoor) {
  const auto openings = over_a_radiator(0.9);
  ASSERT_EQ(openings.size(), 1U);
  EXPECT_EQ(openings[0].kind, "door");
}

TEST(Sills, ADoorWithoutARevealShowsTheFloorBehindIt) {
  for (const bool floor : {true, false}) {
    Scene scene = room_with([](double x, double z) { return x <= 1.2 || x >= 2.9 || z >= 2.2; });
    if (floor)
      scatter(scene, {0.5, -1.5, -0.03}, {3, 0, 0}, {0, 0.8, 0});
    else
      scatter(scene, {0.5, -1.5, 1.2}, {3, 0, 0}, {0, 0.8, 0});
    EXPECT_EQ(laid_out(scene.planes()).building.openings.size(), floor ? 1U : 0U);
  }
}

}  // namespace
}  // namespace atrium::layout::sills_test
