#include "modules/filter/voxel_grid.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>

namespace atrium::filter::voxel_grid_test {
namespace {

Cloud run(const Cloud& cloud, double size) {
  Context context;
  return *VoxelGrid::run({input(cloud)}, {size}, context).cloud;
}

Cloud random_cloud(std::size_t count) {
  Random random(2);
  Cloud cloud;
  cloud.origin = {500000, 5400000, 100};
  for (std::size_t i = 0; i < count; ++i) {
    cloud.points.push_back(
        Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).cast<float>());
    cloud.normals.push_back(
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized().cast<float>());
    cloud.colours.push_back({static_cast<std::uint8_t>(random.index(256)), 7, 255});
    cloud.labels.push_back(static_cast<std::int32_t>(random.index(4)));
    cloud.intensities.push_back(static_cast<float>(random.uniform()));
    cloud.source.push_back(static_cast<std::uint16_t>(i % 2));
  }
  cloud.sensors = {{0, 0, 0}, {1, 1, 1}};
  return cloud;
}

TEST(VoxelGrid, EachVoxelGivesItsCentroid) {
  const Cloud cloud = random_cloud(5000);
  const Cloud thin = run(cloud, 0.25);
  std::map<std::array<int, 3>, std::pair<Eigen::Vector3d, int>> expected;
  for (const auto& p : cloud.points) {
    auto& [sum, n] = expected
                         .try_emplace({static_cast<int>(std::floor(p.x() * 4)), static_cast<int>(std::floor(p.y() * 4)),
                                       static_cast<int>(std::floor(p.z() * 4))},
                                      Eigen::Vector3d::Zero(), 0)
                         .first->second;
    sum += p.cast<double>();
    ++n;
  }
  ASSERT_EQ(thin.size(), expected.size());
  for (const auto& p : thin.points) {
    const auto at = expected.find({static_cast<int>(std::floor(p.x() * 4)), static_cast<int>(std::floor(p.y() * 4)),
                                   static_cast<int>(std::floor(p.z() * 4))});
    ASSERT_NE(at, expected.end());
    EXPECT_LT((p.cast<double>() - at->second.first / at->second.second).norm(), 1e-6);
  }
  EXPECT_EQ(thin.origin, cloud.origin);
  EXPECT_EQ(thin.sensors, cloud.sensors);
  for (const auto& n : thin.normals) EXPECT_NEAR(n.norm(), 1, 1e-5);
}

TEST(VoxelGrid, ColumnsAreMergedAsDocumented) {
  Cloud cloud;
  cloud.points = {{0.2F, 0.2F, 0.2F}, {0.4F, 0.2F, 0.2F}, {0.6F, 0.2F, 0.2F}, {5, 5, 5}, {5, 5, 5}};
  cloud.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, -1}};
  cloud.colours = {{0, 10, 255}, {1, 10, 255}, {1, 13, 255}, {9, 9, 9}, {9, 9, 9}};
  cloud.labels = {4, 2, 2, 8, 3};
  cloud.intensities = {1, 2, 6, 0, 0};
  cloud.source = {1, 0, 0, 0, 1};
  const Cloud thin = run(cloud, 1);
  ASSERT_EQ(thin.size(), 2U);
  EXPECT_TRUE(thin.points[0].isApprox(Eigen::Vector3f(0.4F, 0.2F, 0.2F)));
  EXPECT_TRUE(thin.normals[0].isApprox(Eigen::Vector3f(1, 1, 1).normalized()));
  EXPECT_EQ(thin.colours[0], (Colour{1, 11, 255}));
  EXPECT_EQ(thin.labels, (std::vector<std::int32_t>{2, 3}));
  EXPECT_FLOAT_EQ(thin.intensities[0], 3);
  EXPECT_EQ(thin.source, (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(thin.normals[1], Eigen::Vector3f(0, 0, 1));  // opposite normals cancel out: the first point's
}

TEST(VoxelGrid, ShufflingThePointsMovesNoCentroid) {
  Cloud cloud = random_cloud(20000);
  cloud.source.clear();
  std::vector<std::uint32_t> indices(cloud.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>((i * 7919) % indices.size());
  const Cloud a = run(cloud, 0.1);
  const Cloud b = run(select(cloud, indices), 0.1);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.colours, b.colours);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a.points[i] - b.points[i]).norm(), 1e-6F);
}

TEST(VoxelGrid, SameBytesOnAnyNumberOfThreads) {
  const Cloud cloud = random_cloud(100000);
  std::string one;
  tbb::task_arena(1).execute([&] { one = content_hash(run(cloud, 0.03)); });
  for (const int threads : {2, 4})
    tbb::task_arena(threads).execute([&] { EXPECT_EQ(content_hash(run(cloud, 0.03)), one); });
}

TEST(VoxelGrid, EmptyOnePointAndDuplicates) {
  EXPECT_EQ(run({}, 0.02).size(), 0U);
  Cloud cloud;
  cloud.points = {{1, 2, 3}};
  EXPECT_EQ(run(cloud, 0.02).points, cloud.points);
  cloud.points.assign(50000, {1, 2, 3});
  EXPECT_EQ(run(cloud, 0.02).points, (std::vector<Eigen::Vector3f>{{1, 2, 3}}));
}

TEST(VoxelGrid, HandsOnWhatItWouldLeaveAsItIs) {
  Cloud thin;
  for (int i = 0; i < 5000; ++i) thin.points.emplace_back(0.05F + 0.1F * static_cast<float>(i), 0.5F, 0.5F);
  Context context;
  const auto in = input(thin);
  EXPECT_EQ(VoxelGrid::run({in}, {0.1}, context).cloud, in) << "the same object, not a copy";
  std::swap(thin.points[0], thin.points[1]);  // another order
  const auto swapped = input(thin);
  const auto sorted = VoxelGrid::run({swapped}, {0.1}, context).cloud;
  EXPECT_NE(sorted, swapped);
  EXPECT_EQ(sorted->points, in->points);
}

TEST(VoxelGrid, WildPointsAreKeptButATooWideCloudIsAnError) {
  Cloud cloud;
  cloud.points.assign(1000, {1, 2, 3});
  cloud.points.emplace_back(1e6F, 0, 0);
  EXPECT_EQ(run(cloud, 0.02).points, (std::vector<Eigen::Vector3f>{{1, 2, 3}, {1e6F, 0, 0}}));
  Cloud wide;
  for (int i = 0; i < 1000; ++i) wide.points.emplace_back(static_cast<float>(i) * 1000, 0, 0);
  EXPECT_THROW(run(wide, 0.001), Error);
  EXPECT_EQ(run(wide, 100).size(), 1000U);
}

}  // namespace
}  // namespace atrium::filter::voxel_grid_test
