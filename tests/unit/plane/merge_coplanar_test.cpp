#include "modules/plane/merge_coplanar.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/rooms.hpp"

namespace atrium::plane::merge_coplanar_test {
namespace {

using atrium::test::Rooms;
using Eigen::Vector3d;

PlanePrimitives merged(const PlanePrimitives& planes, const MergeCoplanar::Params& params = {}) {
  Context context;
  return MergeCoplanar::run({input(planes)}, params, context).planes;
}

/// A square of side `size` that looks up, turned about the y axis by `tilt` radians about its middle.
void add_square(Rooms& rooms, const Vector3d& corner, double size, double tilt = 0) {
  const Vector3d along = size * Vector3d(std::cos(tilt), 0, std::sin(tilt));
  const Vector3d middle = corner + Vector3d(size / 2, size / 2, 0);
  rooms.add(middle - along / 2 - Vector3d(0, size / 2, 0), along, {0, size, 0}, {-std::sin(tilt), 0, std::cos(tilt)});
}

TEST(MergeCoplanar, AWallOnBothSidesOfADoor) {
  Rooms rooms;
  rooms.wall(0, 0, 2, 0).wall(3, 0, 4, 0).wall(0, 0.5, 4, 0.5);
  const auto out = merged(rooms.unsorted());
  ASSERT_EQ(out.primitives.size(), 2U);
  EXPECT_EQ(out.primitives[0].inliers.size() + out.primitives[1].inliers.size(), out.cloud->points.size());
  for (const auto& p : out.primitives) {
    EXPECT_NEAR(p.plane.normal.y(), 1, 1e-6);
    EXPECT_LT(p.residual, 1e-5);
    EXPECT_TRUE(std::is_sorted(p.inliers.begin(), p.inliers.end()));
  }
}

TEST(MergeCoplanar, SidesOfAThinWallAreTwoPlanes) {
  Rooms rooms;
  rooms.wall(0, 0, 4, 0).wall(4, 0.001, 0, 0.001);  // back to back
  const auto out = merged(rooms.unsorted());
  ASSERT_EQ(out.primitives.size(), 2U);
  EXPECT_LT(out.primitives[0].plane.normal.dot(out.primitives[1].plane.normal), -0.99);
}

TEST(MergeCoplanar, AStepStaysUnlessItLiesOverTheOther) {
  // Beside one another: two levels. A step of 1 cm is more than 5 mm, the least distance.
  Rooms beside;
  beside.floor(0, 0, 3, 3).floor(3.1, 0, 6, 3, 0.02);
  EXPECT_EQ(merged(beside.unsorted()).primitives.size(), 2U);
  // One before the other: sheets of one surface up to 8 cm, and the larger one's plane stands.
  Rooms sheets;
  sheets.floor(0, 0, 3, 3).floor(1, 1, 2, 2, 0.03);
  const auto out = merged(sheets.unsorted());
  ASSERT_EQ(out.primitives.size(), 1U);
  EXPECT_NEAR(out.primitives[0].plane.offset, 0, 1e-6);
  EXPECT_EQ(merged(sheets.unsorted(), {.sheet_distance = 0.01, .layer_distance = 0.01}).primitives.size(), 2U);
  // Points before points: layers of one surface up to 20 cm.
  Rooms layers, apart;
  layers.floor(0, 0, 3, 3).floor(1, 1, 2, 2, 0.15);
  EXPECT_EQ(merged(layers.unsorted()).primitives.size(), 1U);
  apart.floor(0, 0, 3, 3).floor(1, 1, 2, 2, 0.25);
  EXPECT_EQ(merged(apart.unsorted()).primitives.size(), 2U);
  // A cupboard's front hides what is behind it: a step.
  Rooms cupboard;
  cupboard.floor(0, 0, 3, 1).floor(0, 2, 3, 3).floor(0, 1, 3, 2, 0.15);
  EXPECT_EQ(merged(cupboard.unsorted()).primitives.size(), 2U);
}

TEST(MergeCoplanar, SmallPiecesMayBeTurnedByMoreThanLargeOnes) {
  constexpr double tilt = 0.035;  // 2°: 1 cm over 0.3 m, 10 cm over 3 m
  Rooms small, large;
  add_square(small, {0, 0, 0}, 3);
  add_square(small, {3.2, 1, 0}, 0.2, tilt);
  add_square(large, {0, 0, 0}, 3);
  add_square(large, {3.2, 0, 0}, 3, tilt);
  EXPECT_EQ(merged(small.unsorted()).primitives.size(), 1U);
  EXPECT_EQ(merged(large.unsorted()).primitives.size(), 2U);
}

TEST(MergeCoplanar, NoiseWidensWhatIsOnePlane) {
  Rooms rooms;
  rooms.noise = 0.02;
  rooms.floor(0, 0, 4, 4).floor(4.1, 0, 6, 4, 0.02);
  EXPECT_EQ(merged(rooms.unsorted()).primitives.size(), 1U);
}

TEST(MergeCoplanar, TheOrderOfPrimitivesDoesNotMatter) {
  Rooms rooms;
  rooms.wall(0, 0, 5, 0).wall(6, 0, 6.5, 0).wall(7, 0.002, 8, 0.002).wall(0, 3, 4, 3).wall(4.2, 3.03, 4.6, 3.03);
  rooms.floor(0, 0, 5, 3).floor(6, 0, 7, 2.9);
  PlanePrimitives planes = rooms.unsorted();
  const auto before = merged(planes);
  std::reverse(planes.primitives.begin(), planes.primitives.end());
  const auto after = merged(planes);
  ASSERT_EQ(before.primitives.size(), after.primitives.size());
  for (std::size_t i = 0; i < before.primitives.size(); ++i) {
    EXPECT_EQ(before.primitives[i].inliers, after.primitives[i].inliers);
    EXPECT_LT((before.primitives[i].plane.normal - after.primitives[i].plane.normal).norm(), 1e-9);
  }
}

TEST(MergeCoplanar, PrimitivesWithFewOrNoPoints) {
  EXPECT_TRUE(merged(PlanePrimitives{}).primitives.empty());
  PlanePrimitives planes = Rooms().floor(0, 0, 3, 3).stray({5, 5, 0}).stray({7, 7, 1}).unsorted();
  const auto n = static_cast<std::uint32_t>(planes.cloud->points.size());
  planes.primitives.push_back({{{0, 0, 1}, 0}, {}, 0});        // none
  planes.primitives.push_back({{{0, 0, 1}, 0}, {n - 2}, 0});   // one, on the floor's plane
  planes.primitives.push_back({{{0, 0, 1}, -1}, {n - 1}, 0});  // one, elsewhere
  const auto out = merged(planes);
  ASSERT_EQ(out.primitives.size(), 2U);
  EXPECT_EQ(out.primitives[0].inliers.size(), n - 1U);
  EXPECT_NEAR(out.primitives[1].plane.offset, -1, 1e-12);
  // All points in one place.
  PlanePrimitives place = Rooms().stray({1, 1, 1}).stray({1, 1, 1}).stray({1, 1, 1}).unsorted();
  place.primitives.push_back({{{0, 0, 1}, -1}, {0, 1}, 0});
  place.primitives.push_back({{{0, 0, 1}, -1}, {2}, 0});
  for (const auto& p : merged(place).primitives) EXPECT_TRUE(p.plane.normal.allFinite());
}

TEST(MergeCoplanar, IsTheSameWhereverTheCloudLies) {
  Rooms near, far;
  for (auto* rooms : {&near, &far}) rooms->wall(0, 0, 2, 0).wall(3, 0, 4, 0).wall(0, 0.5, 4, 0.5);
  far.origin({5e5, 5.4e6, 300});
  const auto a = merged(near.unsorted()), b = merged(far.unsorted());
  ASSERT_EQ(a.primitives.size(), b.primitives.size());
  for (std::size_t i = 0; i < a.primitives.size(); ++i)
    EXPECT_EQ(a.primitives[i].plane.offset, b.primitives[i].plane.offset);
}

// Whatever the primitives: no point is lost or doubled, and each is near its plane.
RC_GTEST_PROP(MergeCoplanar, KeepsAllPoints, (std::uint32_t seed)) {
  Random random(seed);
  Rooms rooms;
  rooms.spacing = 0.2;
  rooms.noise = random.uniform(0, 0.01);
  for (std::uint64_t i = 0; i < 2 + random.index(12); ++i) {
    const double z = 0.02 * static_cast<double>(random.index(5));
    add_square(rooms, {random.uniform(0, 5), random.uniform(0, 5), z}, random.uniform(0.3, 3),
               random.uniform(-0.05, 0.05));
  }
  const PlanePrimitives planes = rooms.unsorted();
  const auto out = merged(planes);
  std::set<std::uint32_t> seen;
  std::size_t count = 0, last = planes.cloud->points.size();
  for (const auto& p : out.primitives) {
    seen.insert(p.inliers.begin(), p.inliers.end());
    count += p.inliers.size();
    RC_ASSERT(p.inliers.size() <= last);
    last = p.inliers.size();
    RC_ASSERT(std::abs(p.plane.normal.norm() - 1) < 1e-9);
    RC_ASSERT(p.plane.normal.z() > 0);
    for (const auto i : p.inliers)
      RC_ASSERT(std::abs(p.plane.signed_distance(planes.cloud->points[i].cast<double>())) < 0.08 + 6 * 0.01 + 0.1);
  }
  RC_ASSERT(count == planes.cloud->points.size());
  RC_ASSERT(seen.size() == count);
}

}  // namespace
}  // namespace atrium::plane::merge_coplanar_test
