// Gaps in walls that are no ways: doorways whose lintel was not seen, and necks too narrow to pass.
#include <gtest/gtest.h>

#include "modules/layout/doorways.hpp"
#include "modules/layout/room_necks.hpp"
#include "tests/unit/layout/cells.hpp"

namespace atrium::layout::gaps_test {
namespace {

using namespace atrium::test;
using Line = Arrangement::Line;

/// Two rooms of 4 m × 4 m with a wall of 12 cm between them that has a gap from y = 1 to 1 + `gap`. Its faces were seen
/// up to `top`; no ceiling was scanned.
StoreyCells with_gap(double gap, double top) {
  StoreyCells storey = cells_of({0, 0}, {8.12, 4},
                                {Line{Eigen::Vector2d::UnitX(), -4}, Line{Eigen::Vector2d::UnitX(), -4.12},
                                 Line{Eigen::Vector2d::UnitY(), -1}, Line{Eigen::Vector2d::UnitY(), -(1 + gap)}});
  storey.wall_end = top;
  for (auto& edge : storey.edges) {
    const Eigen::Vector2d p = (storey.vertices[edge.from] + storey.vertices[edge.to]) / 2;
    if ((p.x() != 4 && p.x() != 4.12) || (p.y() > 1 && p.y() < 1 + gap)) continue;
    const bool upwards = storey.vertices[edge.to].y() > storey.vertices[edge.from].y();
    const bool left = upwards == (p.x() == 4);  // the face at x = 4 looks to smaller x
    (left ? edge.face_left : edge.face_right) = 1;
    (left ? edge.top_left : edge.top_right) = top;
  }
  return storey;
}

/// Whether the gap is closed on both faces of the wall.
bool closed(StoreyCells storey, double gap) {
  close_doorways(storey);
  int open = 0;
  for (const auto& edge : storey.edges) {
    const Eigen::Vector2d p = (storey.vertices[edge.from] + storey.vertices[edge.to]) / 2;
    if ((p.x() == 4 || p.x() == 4.12) && p.y() > 1 && p.y() < 1 + gap)
      open += std::max(edge.wall_left, edge.wall_right) > 0.5 ? 0 : 1;
    else
      EXPECT_EQ(std::max(edge.wall_left, edge.wall_right), 0) << "only gaps are closed";
  }
  return open == 0;
}

TEST(Gaps, ADoorwayWhoseLintelWasNotSeenIsClosed) {
  EXPECT_TRUE(closed(with_gap(0.9, 1.6), 0.9));
  EXPECT_TRUE(closed(with_gap(0.3, 1.6), 0.3));
  EXPECT_FALSE(closed(with_gap(1.6, 1.6), 1.6)) << "wider than a door";
  EXPECT_FALSE(closed(with_gap(0.9, 2.5), 0.9)) << "a lintel would have been seen";
  EXPECT_TRUE(closed(with_gap(0.3, 2.5), 0.3)) << "too narrow to pass";
}

TEST(Gaps, ACorridorBetweenTwoWallsOfOneLineStaysOpen) {
  StoreyCells storey = with_gap(1.2, 1.6);
  for (auto& edge : storey.edges) {
    const Eigen::Vector2d p = (storey.vertices[edge.from] + storey.vertices[edge.to]) / 2;
    if ((p.y() != 1 && p.y() != 2.2) || (p.x() > 4 && p.x() < 4.12)) continue;
    edge.face_left = edge.face_right = 1;
    edge.top_left = edge.top_right = 1.6;
  }
  EXPECT_FALSE(closed(storey, 1.2));
}

std::vector<std::vector<std::size_t>> parts(double gap) {
  const StoreyCells storey = with_gap(gap, 2.5);
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < storey.cells.size(); ++i) {
    const Eigen::Vector2d p = middle_of(storey, storey.cells[i]);
    if (p.x() < 4 || p.x() > 4.12 || (p.y() > 1 && p.y() < 1 + gap)) inside.push_back(i);
  }
  return parted_at_necks(storey, inside);
}

TEST(Gaps, RoomsArePartedWhereNobodyPasses) {
  ASSERT_EQ(parts(0.2).size(), 2U);
  EXPECT_EQ(parts(0.2)[0].size(), 3U);
  EXPECT_EQ(parts(0.2)[1].size(), 3U) << "the neck is in neither";
  ASSERT_EQ(parts(0.6).size(), 1U);
  EXPECT_EQ(parts(0.6)[0].size(), 7U);
  EXPECT_TRUE(parted_at_necks(with_gap(0.2, 2.5), {}).empty());
}

}  // namespace
}  // namespace atrium::layout::gaps_test
