#include "modules/layout/second_opinion.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/box_building.hpp"

namespace atrium::layout::second_opinion_test {
namespace {

Building boxes(const std::vector<std::array<double, 6>>& rooms) {
  atrium::test::BoxBuilding b;
  for (const auto& r : rooms) b.room(r[0], r[1], r[2], r[3], r[4], r[5]);
  return b.building;
}

TEST(SecondOpinion, TheSameRoomsShareAll) {
  const auto rooms = boxes({{0, 0, 4, 3, 0, 2.5}, {4.1, 0, 8, 3, 0, 2.5}});
  for (const auto& opinion : second_opinions(rooms, rooms)) {
    EXPECT_NEAR(opinion.shared, 1, 1e-9);
    EXPECT_EQ(opinion.parts, 1U);
  }
}

TEST(SecondOpinion, ARoomThatIsTwoIsToldOf) {
  const auto one = boxes({{0, 0, 8, 3, 0, 2.5}}), two = boxes({{0, 0, 5, 3, 0, 2.5}, {5.1, 0, 8, 3, 0, 2.5}});
  const auto joined = second_opinions(one, two), parted = second_opinions(two, one);
  EXPECT_NEAR(joined[0].shared, 15.0 / 24, 1e-9);
  EXPECT_NEAR(joined[0].area, 15, 1e-9);
  EXPECT_EQ(joined[0].parts, 2U);
  EXPECT_NEAR(parted[1].shared, 8.7 / 24, 1e-9);
  EXPECT_EQ(parted[1].parts, 0U);
}

TEST(SecondOpinion, ACorridorAroundACoreIsNotTheHallOfBoth) {
  Building ring = boxes({{0, 0, 20, 10, 0, 2.5}, {2, 1, 18, 9, 0, 2.5}});
  for (const auto& p :
       {Eigen::Vector3d(2, 1, 0), Eigen::Vector3d(2, 9, 0), Eigen::Vector3d(18, 9, 0), Eigen::Vector3d(18, 1, 0)}) {
    if (ring.rooms[0].holes.empty()) ring.rooms[0].holes.emplace_back();
    ring.rooms[0].holes[0].push_back(p);
  }
  const auto opinions = second_opinions(ring, boxes({{0, 0, 20, 10, 0, 2.5}}));
  EXPECT_NEAR(opinions[0].shared, 72.0 / 200, 1e-9);
  EXPECT_NEAR(opinions[1].shared, 128.0 / 200, 1e-9);
}

TEST(SecondOpinion, RoomsOnOtherStoreysAndNoRoomsSayNothing) {
  const auto below = boxes({{0, 0, 4, 3, 0, 2.5}}), above = boxes({{0, 0, 4, 3, 2.8, 5.3}});
  EXPECT_EQ(second_opinions(below, above)[0].area, 0);
  EXPECT_EQ(second_opinions(below, Building{})[0].area, 0);
  EXPECT_TRUE(second_opinions(Building{}, below).empty());
}

}  // namespace
}  // namespace atrium::layout::second_opinion_test
