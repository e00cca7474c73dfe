#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "modules/filter/outliers.hpp"
#include "modules/filter/voxel_grid.hpp"
#include "modules/geometry/point_tree.hpp"
#include "modules/normal/estimate.hpp"
#include "modules/pcl/clusters.hpp"
#include "modules/pcl/normals.hpp"
#include "modules/pcl/outliers.hpp"
#include "modules/pcl/voxel_grid.hpp"
#include "tests/bench/box_flat.hpp"
#include "tests/support/warnings.hpp"

namespace atrium::pcl_nodes::points_test {
namespace {

template <class Node>
auto run(const Cloud& cloud, typename Node::Params params = {}) {
  test::Warnings warnings;
  if constexpr (requires { Node::run({input(cloud)}, params, warnings.context()); })
    return Node::run({input(cloud)}, params, warnings.context());
  else
    return Node::run({input(cloud)}, params);
}

/// A flat without the columns that PCL has no room for, in world coordinates.
Cloud flat(std::size_t points) {
  Cloud cloud = bench::box_flat(points);
  cloud.source.clear();
  cloud.origin = {500000, 5400000, 100};
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.colours.push_back({static_cast<std::uint8_t>(i % 256), 100, static_cast<std::uint8_t>(i / 256 % 256)});
  return cloud;
}

/// Share of the points of `a` that have one of `b` within `distance`.
double share_near(const Cloud& a, const Cloud& b, float distance) {
  Context context;
  const PointTree tree(b.points, context);
  std::size_t near = 0;
  Neighbour neighbour{};
  for (const auto& p : a.points) near += tree.nearest(p, neighbour, distance) ? 1 : 0;
  return static_cast<double>(near) / static_cast<double>(a.size());
}

TEST(PclVoxelGrid, GivesThePointsOfOursWithinTenMicrometres) {
  const Cloud cloud = flat(100000);
  const Cloud theirs = run<VoxelGrid>(cloud, {0.1}).cloud;
  const Cloud ours = *run<filter::VoxelGrid>(cloud, {0.1}).cloud;
  EXPECT_LT(theirs.size(), cloud.size() / 2);
  // A point on the border of two voxels may fall into either.
  EXPECT_NEAR(static_cast<double>(theirs.size()), static_cast<double>(ours.size()), 0.001 * cloud.size());
  EXPECT_GT(share_near(ours, theirs, 1e-5F), 0.995);
  EXPECT_GT(share_near(theirs, ours, 1e-5F), 0.995);
  EXPECT_EQ(theirs.origin, cloud.origin);
  EXPECT_EQ(theirs.sensors, cloud.sensors);
}

TEST(PclVoxelGrid, MergesNormalsAndColours) {
  Cloud cloud;
  cloud.points = {{0.01F, 0, 0}, {0.03F, 0, 0}, {1, 1, 1}};
  cloud.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  cloud.colours = {{10, 20, 30}, {30, 40, 50}, {1, 2, 3}};
  const Cloud merged = run<VoxelGrid>(cloud, {0.1}).cloud;
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_NEAR((merged.normals[0] - Eigen::Vector3f(1, 1, 0).normalized()).norm(), 0, 1e-6);
  EXPECT_EQ(merged.colours[0], (Colour{20, 30, 40}));
  EXPECT_EQ(merged.colours[1], (Colour{1, 2, 3}));
}

TEST(PclVoxelGrid, NormalsThatCancelOutAreNamed) {
  Cloud cloud;
  cloud.points = {{0.01F, 0, 0}, {0.03F, 0, 0}};
  cloud.normals = {{1, 0, 0}, {-1, 0, 0}};
  test::Warnings warnings;
  EXPECT_EQ(VoxelGrid::run({input(cloud)}, {0.1}, warnings.context()).cloud.normals[0], Eigen::Vector3f::UnitZ());
  EXPECT_EQ(warnings.texts().size(), 1U);
}

TEST(PclVoxelGrid, NamesTheColumnsThatItDrops) {
  Cloud cloud;
  cloud.points = {{0, 0, 0}, {1, 1, 1}};
  cloud.labels = {1, 2};
  cloud.source = {0, 1};
  test::Warnings warnings;
  const Cloud thinned = VoxelGrid::run({input(cloud)}, {0.1}, warnings.context()).cloud;
  ASSERT_EQ(warnings.texts().size(), 1U);
  EXPECT_NE(warnings.texts()[0].find("labels, sources"), std::string::npos);
  EXPECT_TRUE(thinned.labels.empty());
}

TEST(PclVoxelGrid, ThinsScansThatAreTooWideForPclsNumbers) {
  Cloud cloud;
  for (const float far : {-300.0F, 0.0F, 10.235F, 300.0F})
    for (int i = 0; i < 10; ++i) cloud.points.emplace_back(far + 0.0001F * static_cast<float>(i), far, far);
  const Cloud thinned = run<VoxelGrid>(cloud, {0.01}).cloud;
  const Cloud ours = *run<filter::VoxelGrid>(cloud, {0.01}).cloud;
  EXPECT_EQ(thinned.size(), ours.size());
  EXPECT_EQ(share_near(ours, thinned, 1e-4F), 1);
  cloud.points.emplace_back(1e9F, 0.0F, 0.0F);
  EXPECT_THROW(run<VoxelGrid>(cloud, {0.01}), Error);
}

/// A plane with 1 cm between its points, and 100 points off it.
Cloud plane_with_outliers() {
  Random random(6);
  Cloud cloud;
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y)
      cloud.points.emplace_back(0.01F * static_cast<float>(x), 0.01F * static_cast<float>(y), 0.0F);
  for (int i = 0; i < 100; ++i)
    cloud.points.push_back(Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform(0.3, 2)).cast<float>());
  for (int i = 0; i < 10100; ++i) cloud.labels.push_back(i < 10000 ? 0 : 1);
  return cloud;
}

TEST(PclOutliers, StatisticsTellThePointsThatOursTell) {
  const Cloud cloud = flat(50000);
  Outliers::Params params;
  params.deviations = 2;
  const auto theirs = run<Outliers>(cloud, params);
  const auto ours = run<filter::Outliers>(cloud, {16, 2});
  EXPECT_GT(theirs.removed, 100);
  EXPECT_NEAR(static_cast<double>(theirs.removed), static_cast<double>(ours.removed), 0.02 * ours.removed + 5);
  EXPECT_GT(share_near(ours.cloud, theirs.cloud, 1e-7F), 0.999);
  EXPECT_EQ(theirs.cloud.colours.size(), theirs.cloud.size());
}

TEST(PclOutliers, BothMethodsRemoveWhatStandsAlone) {
  for (const auto method : {OutlierMethod::statistical, OutlierMethod::radius}) {
    Outliers::Params params;
    params.method = method;
    params.radius = 0.05;
    const auto out = run<Outliers>(plane_with_outliers(), params);
    EXPECT_EQ(std::count(out.cloud.labels.begin(), out.cloud.labels.end(), 1), 0);
    EXPECT_GT(out.cloud.size(), 9900U);
    EXPECT_EQ(out.removed, static_cast<std::int64_t>(10100 - out.cloud.size()));
  }
}

TEST(PclOutliers, FewPointsAreHandedOn) {
  Cloud cloud;
  cloud.points = {{0, 0, 0}, {1, 0, 0}};
  test::Warnings warnings;
  EXPECT_EQ(Outliers::run({input(cloud)}, {}, warnings.context()).cloud.size(), 2U);
  EXPECT_EQ(warnings.texts().size(), 1U);
}

TEST(PclNormals, AreThoseOfOurMethodsOfTheSameKind) {
  const Cloud cloud = flat(30000);
  for (const auto method : {Neighbourhood::radius, Neighbourhood::neighbours}) {
    normal::Estimate::Params params;
    params.method = method == Neighbourhood::radius ? normal::Method::radius : normal::Method::neighbours;
    params.radius = 0.2;
    const Cloud ours = run<normal::Estimate>(cloud, params).cloud;
    const Cloud theirs = run<Normals>(cloud, {method, 0.2, 16}).cloud;
    ASSERT_EQ(theirs.normals.size(), cloud.size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      EXPECT_NEAR(theirs.normals[i].norm(), 1, 1e-5);
      EXPECT_GE(theirs.normals[i].dot(cloud.normals[i]), 0);  // the side of the normals before
      same += ours.normals[i].dot(theirs.normals[i]) > std::cos(0.01) ? 1 : 0;
    }
    EXPECT_GT(static_cast<double>(same), 0.98 * static_cast<double>(cloud.size()));
  }
}

TEST(PclNormals, LonelyPointsAreCountedAndPointUp) {
  Cloud cloud;
  cloud.points = {{0, 0, 0}, {10, 0, 0}};
  test::Warnings warnings;
  const Cloud out = Normals::run({input(cloud)}, {}, warnings.context()).cloud;
  EXPECT_EQ(out.normals[1], Eigen::Vector3f::UnitZ());
  ASSERT_EQ(warnings.texts().size(), 1U);
  EXPECT_EQ(warnings.texts()[0].substr(0, 6), "2 of 2");
}

TEST(PclNormals, SameBytesWithAnyNumberOfThreads) {
  const Cloud cloud = flat(20000);
  Cloud one, four;
  tbb::task_arena(1).execute([&] { one = run<Normals>(cloud).cloud; });
  tbb::task_arena(4).execute([&] { four = run<Normals>(cloud).cloud; });
  EXPECT_EQ(content_hash(one), content_hash(four));
}

/// Three balls of 300, 500 and 100 points in a row, shuffled, and 20 points alone.
Cloud balls() {
  Random random(3);
  Cloud cloud;
  const auto add = [&](int n, float x) {
    for (int i = 0; i < n; ++i)
      cloud.points.push_back(
          Eigen::Vector3d(x + random.uniform(0, 0.2), random.uniform(0, 0.2), random.uniform(0, 0.2)).cast<float>());
  };
  add(300, 0);
  add(500, 1);
  add(100, 2);
  for (int i = 0; i < 20; ++i) cloud.points.emplace_back(3.0F + static_cast<float>(i), 0.0F, 0.0F);
  cloud.intensities.assign(cloud.size(), 0.5F);
  return cloud;
}

TEST(PclClusters, AreNumberedBySizeAndTheRestGoes) {
  const auto out = run<Clusters>(balls(), {0.1, 50, 0});
  EXPECT_EQ(out.clusters, 3);
  EXPECT_EQ(out.removed, 20);
  ASSERT_EQ(out.cloud.labels.size(), 900U);
  EXPECT_EQ(out.cloud.intensities.size(), 900U);
  for (std::size_t i = 0; i < 900; ++i)
    EXPECT_EQ(out.cloud.labels[i], out.cloud.points[i].x() < 0.5F ? 1 : out.cloud.points[i].x() < 1.5F ? 0 : 2);
}

TEST(PclClusters, BoundsOfSizeHold) {
  EXPECT_EQ(run<Clusters>(balls(), {0.1, 200, 0}).clusters, 2);
  EXPECT_EQ(run<Clusters>(balls(), {0.1, 50, 400}).clusters, 2);
  EXPECT_EQ(run<Clusters>(balls(), {2, 50, 0}).clusters, 1);
}

template <class Node>
class PclPointsNode : public testing::Test {};
using Nodes = testing::Types<VoxelGrid, Outliers, Normals, Clusters>;
TYPED_TEST_SUITE(PclPointsNode, Nodes);

TYPED_TEST(PclPointsNode, AnEmptyCloudStaysEmptyAndKeepsItsOrigin) {
  Cloud cloud;
  cloud.origin = {1, 2, 3};
  const Cloud out = run<TypeParam>(cloud).cloud;
  EXPECT_EQ(out.size(), 0U);
  EXPECT_EQ(out.origin, cloud.origin);
}

TYPED_TEST(PclPointsNode, GivesTheSameBytesAgain) {
  const Cloud cloud = flat(5000);
  EXPECT_EQ(content_hash(run<TypeParam>(cloud).cloud), content_hash(run<TypeParam>(cloud).cloud));
}

TYPED_TEST(PclPointsNode, DuplicatesDoNoHarm) {
  Cloud cloud;
  cloud.points.assign(1000, {1, 2, 3});
  EXPECT_LE(run<TypeParam>(cloud).cloud.size(), 1000U);
}

}  // namespace
}  // namespace atrium::pcl_nodes::points_test
