#include "modules/plane/settle.hpp"

#include <gtest/gtest.h>

#include "graph/api/random.hpp"

namespace atrium::plane::settle_test {
namespace {

/// A wall at x = 0 with noise of 3 mm, and a share of its points evenly up to 6 cm before it; its plane is their least
/// squares, so their mean.
PlanePrimitives cluttered_wall(double share, std::size_t count = 4000) {
  Random random(7);
  Cloud cloud;
  PlanePrimitive wall;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform() < share ? random.uniform(0, 0.06) : 0.003 * random.normal();
    sum += x;
    wall.inliers.push_back(static_cast<std::uint32_t>(i));
    cloud.points.emplace_back(static_cast<float>(x), static_cast<float>(random.uniform(0, 4)),
                              static_cast<float>(random.uniform(0, 2.5)));
  }
  wall.plane = {Eigen::Vector3d::UnitX(), -sum / static_cast<double>(count)};
  PlanePrimitives planes;
  planes.cloud = std::make_shared<const Cloud>(cloud);
  planes.primitives = {wall};
  return planes;
}

double place_of(const PlanePrimitives& planes, const Settle::Params& params = {}) {
  Context context;
  return -Settle::run({input(planes)}, params, context).planes.primitives[0].plane.offset;
}

TEST(Settle, WhatStandsBeforeAWallDoesNotDrawItIn) {
  for (const double share : {0.0, 0.3, 0.6}) {
    const auto planes = cluttered_wall(share);
    EXPECT_NEAR(place_of(planes), 0, share > 0.5 ? 0.003 : 0.001) << share;
  }
  EXPECT_GT(-cluttered_wall(0.6).primitives[0].plane.offset, 0.015) << "least squares are drawn in";
}

TEST(Settle, RoundedCoordinatesDoNotDrawItToAStep) {
  PlanePrimitives planes = cluttered_wall(0);
  Cloud cloud = *planes.cloud;
  for (auto& p : cloud.points)
    p.x() = std::round(2 * 100 * (p.x() + 0.003F)) / 2 / 100;  // the wall is at 3 mm, steps are of 5
  planes.cloud = std::make_shared<const Cloud>(cloud);
  planes.primitives[0].plane.offset = -0.003;
  EXPECT_NEAR(place_of(planes), 0.003, 0.0007);
}

TEST(Settle, NoPlaneMovesFurtherThanReach) {
  const auto planes = cluttered_wall(0.6);
  const double before = -planes.primitives[0].plane.offset;
  EXPECT_NEAR(place_of(planes, {.reach = 0.005}), before - 0.005, 1e-12);
  EXPECT_EQ(place_of(planes, {.reach = 0}), before);
}

TEST(Settle, FewPointsSayNothingAndResidualsAreThoseOfTheNewPlane) {
  EXPECT_EQ(place_of(cluttered_wall(0.6, 10)), -cluttered_wall(0.6, 10).primitives[0].plane.offset);
  Context context;
  EXPECT_TRUE(Settle::run({input(PlanePrimitives{})}, {}, context).planes.primitives.empty());
  const auto settled = Settle::run({input(cluttered_wall(0))}, {}, context).planes.primitives[0];
  EXPECT_NEAR(settled.residual, 0.003, 0.0003);
  EXPECT_EQ(settled.inliers.size(), 4000U);
}

}  // namespace
}  // namespace atrium::plane::settle_test
