#include "modules/plane/adopt.hpp"

#include <gtest/gtest.h>

namespace atrium::plane::adopt_test {
namespace {

/// A floor at z = 0 over 2 m × 1 m of points 10 cm apart with residuals of 1 cm, and a wall at x = 0 above it.
PlanePrimitives floor_and_wall() {
  Cloud cloud;
  PlanePrimitive floor, wall;
  wall.plane = {Eigen::Vector3d::UnitX(), 0};
  for (int a = 0; a <= 20; ++a)
    for (int b = 0; b <= 10; ++b) {
      const float off = (a + b) % 2 == 0 ? 0.01F : -0.01F;
      floor.inliers.push_back(static_cast<std::uint32_t>(cloud.points.size()));
      cloud.points.emplace_back(static_cast<float>(a) / 10, static_cast<float>(b) / 10, off);
      wall.inliers.push_back(static_cast<std::uint32_t>(cloud.points.size()));
      cloud.points.emplace_back(off, static_cast<float>(a) / 10, 0.1F + static_cast<float>(b) / 10);
    }
  floor.residual = wall.residual = 0.01;
  PlanePrimitives planes;
  planes.cloud = std::make_shared<Cloud>(cloud);
  planes.primitives = {floor, wall};
  return planes;
}

/// Which primitive takes a point in; -1: none.
int home_of(PlanePrimitives planes, const Eigen::Vector3f& point, const Adopt::Params& params = {},
            const Eigen::Vector3f& sensor = {1, 1, 1}) {
  auto cloud = std::make_shared<Cloud>(*planes.cloud);
  const auto index = static_cast<std::uint32_t>(cloud->points.size());
  cloud->points.push_back(point);
  cloud->sensors = {sensor};
  planes.cloud = cloud;
  Context context;
  const PlanePrimitives out = Adopt::run({input(planes)}, params, context).planes;
  for (std::size_t i = 0; i < out.primitives.size(); ++i) {
    const auto& inliers = out.primitives[i].inliers;
    EXPECT_TRUE(std::is_sorted(inliers.begin(), inliers.end()));
    if (inliers.back() == index) return static_cast<int>(i);
  }
  return -1;
}

TEST(Adopt, FreePointsJoinTheNearestPlane) {
  const auto planes = floor_and_wall();
  EXPECT_EQ(home_of(planes, {1.05F, 1.05F, 0.02F}), 0);
  EXPECT_EQ(home_of(planes, {-0.02F, 1.05F, 1.05F}), 1);
  EXPECT_EQ(home_of(planes, {0.01F, 1, 0.005F}), 0);
  EXPECT_EQ(home_of(planes, {0.005F, 1, 0.01F}), 1);
}

TEST(Adopt, NotThoseTooFarOffOrBeyondTheRectangle) {
  const auto planes = floor_and_wall();
  EXPECT_EQ(home_of(planes, {1, 1, 0.032F}), -1);  // three times the noise are 3 cm
  EXPECT_EQ(home_of(planes, {1, 1, 0.032F}, {.distance = 0.04}), 0);
  EXPECT_EQ(home_of(planes, {2.45F, 1, 0}), 0);
  EXPECT_EQ(home_of(planes, {2.55F, 1, 0}), -1);
  EXPECT_EQ(home_of(planes, {2.55F, 1, 0}, {.reach = 0.6}), 0);
}

TEST(Adopt, NotThoseSeenFromBehind) {
  EXPECT_EQ(home_of(floor_and_wall(), {1, 1, 0.01F}, {}, {1, 1, -1}), -1);
  EXPECT_EQ(home_of(floor_and_wall(), {0.01F, 1, 1}, {}, {-1, 1, 1}), -1);
}

TEST(Adopt, NothingToDoIsNoError) {
  Context context;
  EXPECT_TRUE(Adopt::run({input(PlanePrimitives{})}, {}, context).planes.primitives.empty());
  const auto planes = floor_and_wall();
  const auto out = Adopt::run({input(planes)}, {}, context).planes;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(out.primitives[i].inliers, planes.primitives[i].inliers);
}

}  // namespace
}  // namespace atrium::plane::adopt_test
