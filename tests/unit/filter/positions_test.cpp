#include "modules/filter/positions.hpp"

#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"
#include "tests/support/warnings.hpp"

namespace atrium::filter::positions_test {
namespace {

using test::Rooms;
using test::Warnings;

/// Two box rooms beside each other, moved by (dx, dy, dz).
Cloud two_rooms(const Eigen::Vector3d& moved) {
  Rooms rooms;
  for (const auto& [x0, x1] : {std::pair{0.0, 5.0}, {5.12, 9.0}})
    rooms.floor(x0, 0, x1, 4).ceiling(x0, 0, x1, 4).walls({{x0, 0}, {x1, 0}, {x1, 4}, {x0, 4}});
  Cloud cloud = *rooms.planes().cloud;
  for (auto& p : cloud.points) p += moved.cast<float>();
  return cloud;
}
/// What one position saw: the first room only.
Cloud one_room(const Eigen::Vector3d& moved) {
  const Cloud both = two_rooms({0, 0, 0});
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < both.size(); ++i)
    if (both.points[i].x() < 5.06F) seen.push_back(i);
  Cloud cloud = select(both, seen);
  for (auto& p : cloud.points) p += moved.cast<float>();
  return cloud;
}

TEST(Positions, FindsTheOneThatTheFilesOriginIs) {
  Warnings warnings;
  const Cloud found = *Positions::run({input(one_room({-2, -2, -1.2}))}, {}, warnings.context()).cloud;
  ASSERT_EQ(found.sensors.size(), 1U);
  EXPECT_TRUE(found.sensors[0].isZero(1e-6F));
  EXPECT_TRUE(found.source.empty());
  EXPECT_TRUE(warnings.texts().empty());
}

TEST(Positions, FindsNoneInAMapOrOnASurface) {
  Warnings warnings;
  // From the far end of the first room the second one fills most of the directions.
  EXPECT_TRUE(Positions::run({input(two_rooms({-4.6, -2, -1.2}))}, {}, warnings.context()).cloud->sensors.empty());
  EXPECT_TRUE(Positions::run({input(one_room({-2, -2, 0}))}, {}, warnings.context()).cloud->sensors.empty());
  EXPECT_TRUE(Positions::run({input(one_room({20, 0, 0}))}, {}, warnings.context()).cloud->sensors.empty());
  EXPECT_TRUE(warnings.texts().empty());
}

TEST(Positions, LeavesOutTheFilesWhereTheWaysAreNotFree) {
  Cloud cloud = two_rooms({0, 0, 0});
  cloud.sensors = {{2, 2, 1.2F}, {7, 2, 1.2F}};
  for (const auto& p : cloud.points) cloud.source.push_back(p.x() < 5.06F ? 0 : 1);
  Warnings warnings;
  EXPECT_EQ(Positions::run({input(cloud)}, {}, warnings.context()).cloud->sensors.size(), 2U);
  EXPECT_TRUE(warnings.texts().empty());
  for (auto& s : cloud.source) s = static_cast<std::uint16_t>(1 - s);  // each saw the other's room, through the wall
  const Cloud left = *Positions::run({input(cloud)}, {}, warnings.context()).cloud;
  EXPECT_TRUE(left.sensors.empty() && left.source.empty());
  ASSERT_EQ(warnings.texts().size(), 1U);
  EXPECT_NE(warnings.texts()[0].find("left out"), std::string::npos);
}

TEST(Positions, AnEmptyCloudStaysEmpty) {
  Context context;
  EXPECT_EQ(Positions::run({input(Cloud{})}, {}, context).cloud->size(), 0U);
}

}  // namespace
}  // namespace atrium::filter::positions_test
