#include "modules/types/turn_between.hpp"

#include <gtest/gtest.h>

#include "graph/api/random.hpp"

namespace atrium::turn_between_test {
namespace {

using Eigen::Vector3d;

TEST(TurnBetween, TurnsOneDirectionIntoTheOther) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const auto any = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
    const Vector3d from = any(), to = any();
    const Eigen::Quaterniond turn = turn_between(from, to);
    EXPECT_NEAR((turn * from.normalized() - to.normalized()).norm(), 0, 1e-12);
    EXPECT_NEAR(turn.norm(), 1, 1e-12);
    EXPECT_NEAR((turn * from.cross(to) - from.cross(to)).norm(), 0,
                1e-12);  // the least turn: about what is across both
  }
}

TEST(TurnBetween, EqualAndOppositeDirections) {
  EXPECT_TRUE(turn_between({0, 0, 2}, {0, 0, 1}).isApprox(Eigen::Quaterniond::Identity()));
  for (const Vector3d& from : {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(1, 2, -3)})
    for (const double off : {0.0, 1e-8}) {
      const Vector3d to = -from + Vector3d(off, -off, off);
      const Eigen::Quaterniond turn = turn_between(from, to);
      EXPECT_NEAR((turn * from.normalized() - to.normalized()).norm(), 0, 1e-7);
      EXPECT_NEAR(turn.norm(), 1, 1e-7);
    }
}

}  // namespace
}  // namespace atrium::turn_between_test
