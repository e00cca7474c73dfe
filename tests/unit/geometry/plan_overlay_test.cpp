#include "modules/geometry/plan_overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace atrium::overlay::plan_overlay_test {
namespace {

PlanPolygon rectangle(double left, double bottom, double right, double top) {
  return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, {}};
}

TEST(PlanOverlay, TurnsRingsTheWayTheyRun) {
  PlanPolygon turned = rectangle(0, 0, 4, 3);
  turned.holes.push_back(rectangle(1, 1, 2, 2).outline);
  std::reverse(turned.outline.begin(), turned.outline.end());
  EXPECT_DOUBLE_EQ(area(corrected(turned)), 11);
  EXPECT_DOUBLE_EQ(area(corrected(corrected(turned))), 11);
}

TEST(PlanOverlay, CutsAndIntersects) {
  const PlanPolygon wall = rectangle(0, 0, 4, 3), door = rectangle(1, 0, 2, 2), window = rectangle(3, 1, 5, 2);
  auto rest = difference({wall}, door);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].outline.size(), 8U);
  EXPECT_DOUBLE_EQ(area(rest), 10);
  const auto pane = intersection(rest, window);
  ASSERT_EQ(pane.size(), 1U);
  EXPECT_DOUBLE_EQ(area(pane), 1);
  EXPECT_TRUE(centroid(pane).isApprox(Eigen::Vector2d(3.5, 1.5)));
  EXPECT_TRUE(intersection(rest, rectangle(1.2, 0.5, 1.8, 1)).empty());
  EXPECT_EQ(difference({wall}, rectangle(1, -1, 2, 4)).size(), 2U);
}

TEST(PlanOverlay, KeepsHoles) {
  const auto rest = difference({rectangle(0, 0, 4, 3)}, rectangle(1, 1, 2, 2));
  ASSERT_EQ(rest.size(), 1U);
  ASSERT_EQ(rest[0].holes.size(), 1U);
  EXPECT_TRUE(is_valid(rest[0]));
  EXPECT_TRUE(intersection(rest, rectangle(1.2, 1.2, 1.8, 1.8)).empty());
}

TEST(PlanOverlay, TellsWhatIsValidAndCovered) {
  const PlanPolygon bow{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}};
  EXPECT_FALSE(is_valid(corrected(bow)));
  EXPECT_TRUE(covers(rectangle(0, 0, 4, 3), rectangle(0, 0, 1, 3)));
  EXPECT_FALSE(covers(rectangle(0, 0, 4, 3), rectangle(3, 0, 5, 3)));
}

}  // namespace
}  // namespace atrium::overlay::plan_overlay_test
