#include "modules/floorplan/regions.hpp"

#include <gtest/gtest.h>

namespace atrium::floorplan {
namespace {

TEST(Regions, PartsThatAnEdgeOfNoWidthJoinsAreParted) {
  const PlanRing joined_by_a_line = {{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 0}, {3, 0}, {3, 1}, {0, 1}};
  const Region parts = parted({{joined_by_a_line, {}}});
  ASSERT_EQ(parts.size(), 2U);
  for (const auto& part : parts) EXPECT_NEAR(part.area(), 1, 1e-6);
}

TEST(Regions, PartsThatTouchInAPointAreParted) {
  const PlanRing bow = {{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}};
  const Region parts = parted({{bow, {}}});
  ASSERT_EQ(parts.size(), 2U);
  for (const auto& part : parts) EXPECT_NEAR(part.area(), 1, 1e-5);
}

TEST(Regions, WhatHangsTogetherStaysToTheBit) {
  const PlanRing outline = {{0, 0}, {1.0 / 3, 0}, {0.7, 1e-5}, {2, 1}, {0, 1}},
                 hole = {{0.3, 0.8}, {0.4, 0.9}, {0.4, 0.8}};
  const Region same = parted({{outline, {hole}}});
  ASSERT_EQ(same.size(), 1U);
  EXPECT_EQ(same.front().outline, outline);
  ASSERT_EQ(same.front().holes.size(), 1U);
  EXPECT_EQ(same.front().holes.front(), hole);
}

}  // namespace
}  // namespace atrium::floorplan
