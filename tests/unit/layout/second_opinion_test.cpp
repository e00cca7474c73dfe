#include "modules/layout/second_opinion.hpp"

#include <gtest/gtest.h>

#include <array>

#include "modules/layout/confidence.hpp"
#include "tests/support/box_building.hpp"
#include "tests/support/rooms.hpp"

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

TEST(SecondOpinion, RoomsThatAreOthersInAnotherWayAreDoubtful) {
  Structure structure;
  structure.primitives = std::make_shared<const PlanePrimitives>(atrium::test::box_room().planes());
  const auto with = [&](const std::vector<double>& ends) {
    atrium::test::BoxBuilding second;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) second.room(ends[i], 0, ends[i + 1], 3);
    Context context;
    return Confidence::run({input(boxes({{0, 0, 4, 3, 0, 2.5}})), input(structure), {}, input(second.building)}, {},
                           context)
        .building;
  };
  EXPECT_NEAR(with({0, 4}).rooms[0].confidence, 1, 1e-9);
  const Building parted = with({0, 2, 4});
  EXPECT_NEAR(parted.rooms[0].confidence, 0.6, 1e-9);
  ASSERT_FALSE(parted.rooms[0].doubts.empty());
  EXPECT_EQ(parted.rooms[0].doubts.back(), "found in another way, it is 2 rooms, the best of 6.0 m2");
  EXPECT_NEAR(with({}).rooms[0].confidence, 1, 1e-9) << "no rooms are no opinion";
}

}  // namespace
}  // namespace atrium::layout::second_opinion_test
