#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/pcl/ransac.hpp"
#include "modules/pcl/region_growing.hpp"
#include "modules/plane/ransac.hpp"
#include "tests/support/flat_cloud.hpp"

namespace atrium::pcl_nodes::planes_test {
namespace {

template <class Node>
PlanePrimitives find(const Cloud& cloud, typename Node::Params params = {}, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  if constexpr (requires { Node::run({input(cloud)}, params, context); })
    return Node::run({input(cloud)}, params, context).planes;
  else
    return Node::run({input(cloud)}, params).planes;
}

/// A room of 5 m × 4 m × 2.5 m seen from inside.
Cloud room(double noise = 0.004, double normal_error = 2) {
  test::Sampling sampling;
  sampling.points = 20000;
  sampling.noise = noise;
  sampling.outliers = 0.01;
  sampling.normal_error = normal_error;
  return test::sample(test::box_faces({0, 0, 0}, {5, 4, 2.5}, true), sampling);
}

void expect_sound(const PlanePrimitives& planes) {
  std::vector<bool> taken(planes.cloud->size(), false);
  std::size_t before = planes.cloud->size();
  for (const PlanePrimitive& p : planes.primitives) {
    EXPECT_LE(p.inliers.size(), before);
    before = p.inliers.size();
    EXPECT_NEAR(p.plane.normal.norm(), 1, 1e-12);
    EXPECT_TRUE(std::is_sorted(p.inliers.begin(), p.inliers.end()));
    for (const auto i : p.inliers) {
      EXPECT_FALSE(taken[i]);
      taken[i] = true;
    }
  }
}

/// Each of ours has one of theirs: 0.5 degrees, 5 mm, and the same side.
void expect_same_planes(const PlanePrimitives& theirs, const PlanePrimitives& ours) {
  ASSERT_EQ(theirs.primitives.size(), ours.primitives.size());
  for (const auto& o : ours.primitives)
    EXPECT_TRUE(std::any_of(theirs.primitives.begin(), theirs.primitives.end(), [&](const PlanePrimitive& t) {
      return t.plane.normal.dot(o.plane.normal) > std::cos(0.5 * 3.14159 / 180) &&
             std::abs(t.plane.offset - o.plane.offset) < 0.005;
    }));
}

template <class Node>
class PclPlanes : public testing::Test {};
using Nodes = testing::Types<Ransac, RegionGrowing>;
TYPED_TEST_SUITE(PclPlanes, Nodes);

TYPED_TEST(PclPlanes, FindThoseThatOursFind) {
  const Cloud cloud = room();
  const PlanePrimitives theirs = find<TypeParam>(cloud);
  EXPECT_EQ(theirs.cloud->size(), cloud.size());
  expect_sound(theirs);
  ASSERT_EQ(theirs.primitives.size(), 6U);
  expect_same_planes(theirs, find<plane::Ransac>(cloud));
}

TYPED_TEST(PclPlanes, KeepTheLargestOnly) {
  typename TypeParam::Params params;
  params.max_planes = 2;
  const auto planes = find<TypeParam>(room(), params);
  ASSERT_EQ(planes.primitives.size(), 2U);
  for (const auto& p : planes.primitives) EXPECT_GT(std::abs(p.plane.normal.z()), 0.99);  // floor and ceiling
}

TYPED_TEST(PclPlanes, MinPointsIsKept) {
  typename TypeParam::Params params;
  params.min_points = 3000;
  for (const auto& p : find<TypeParam>(room(), params).primitives) EXPECT_GE(p.inliers.size(), 3000U);
  params.min_points = 100000;
  EXPECT_TRUE(find<TypeParam>(room(), params).primitives.empty());
}

TYPED_TEST(PclPlanes, GiveTheSameBytesAgain) {
  const Cloud cloud = room();
  EXPECT_EQ(content_hash(find<TypeParam>(cloud)), content_hash(find<TypeParam>(cloud)));
}

TYPED_TEST(PclPlanes, FewPointsAreAnError) {
  EXPECT_THROW(find<TypeParam>(Cloud{}), Error);
  Cloud two;
  two.points = {{0, 0, 0}, {1, 0, 0}};
  two.normals.assign(2, Eigen::Vector3f::UnitZ());
  EXPECT_THROW(find<TypeParam>(two), Error);
}

TYPED_TEST(PclPlanes, PointsInOnePlaceDoNoHarm) {
  Cloud cloud;
  cloud.points.assign(200, {1, 2, 3});
  cloud.normals.assign(200, Eigen::Vector3f::UnitZ());
  for (const auto& p : find<TypeParam>(cloud).primitives) EXPECT_TRUE(p.plane.normal.allFinite());
}

TEST(PclRansac, NeedsNormalsOnlyForTheirWeight) {
  Cloud cloud = room();
  Ransac::Params params;
  params.normal_weight = 0.1;
  params.distance = 0.05;
  EXPECT_GE(find<Ransac>(cloud, params).primitives.size(), 6U);
  cloud.normals.clear();
  EXPECT_THROW(find<Ransac>(cloud, params), Error);
  params.normal_weight = 0;
  const auto planes = find<Ransac>(cloud, params);
  ASSERT_GE(planes.primitives.size(), 6U);
  EXPECT_GT(planes.primitives[0].plane.normal.z(), 0.99);  // up, where nothing says a side
}

TEST(PclRansac, AnotherSeedFindsTheSamePlanesByOtherSamples) {
  const Cloud cloud = room();
  const auto one = find<Ransac>(cloud, {}, 1), two = find<Ransac>(cloud, {}, 2);
  expect_same_planes(two, one);
  EXPECT_NE(content_hash(one), content_hash(two));
}

TEST(PclRegionGrowing, NeedsNormals) {
  Cloud cloud = room();
  cloud.normals.clear();
  EXPECT_THROW(find<RegionGrowing>(cloud), Error);
}

}  // namespace
}  // namespace atrium::pcl_nodes::planes_test
