#include "modules/filter/outliers.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

namespace atrium::filter::outliers_test {
namespace {

Outliers::Out run(const Cloud& cloud, Outliers::Params params = {}) {
  Context context;
  return Outliers::run({input(cloud)}, params, context);
}

/// A plane of 1 cm spacing, jittered, labels 0, and points at least 20 cm off it, label 1.
Cloud plane_with_outliers(std::size_t outliers) {
  Random random(6);
  Cloud cloud;
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y) {
      cloud.points.push_back(
          Eigen::Vector3d(x * 0.01 + random.uniform(0, 0.004), y * 0.01 + random.uniform(0, 0.004), 0).cast<float>());
      cloud.labels.push_back(0);
    }
  for (std::size_t i = 0; i < outliers; ++i) {
    cloud.points.push_back(Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform(0.2, 2)).cast<float>());
    cloud.labels.push_back(1);
  }
  return cloud;
}

std::size_t outliers_in(const Cloud& cloud) {
  return static_cast<std::size_t>(std::count(cloud.labels.begin(), cloud.labels.end(), 1));
}

TEST(Outliers, StrayPointsGoAndTheSurfaceStays) {
  const auto out = run(plane_with_outliers(100));
  EXPECT_EQ(outliers_in(out.cloud), 0U);
  EXPECT_GT(out.cloud.size(), 9500U);  // corners and borders have further neighbours
  EXPECT_EQ(out.removed, static_cast<std::int64_t>(10100 - out.cloud.size()));
}

TEST(Outliers, AWildPointDoesNotHideTheOthers) {
  Cloud cloud = plane_with_outliers(100);
  cloud.points.emplace_back(1e6F, 1e6F, 1e6F);
  cloud.labels.push_back(1);
  const auto out = run(cloud);
  EXPECT_EQ(outliers_in(out.cloud), 0U);
  EXPECT_GT(out.cloud.size(), 9500U);
}

TEST(Outliers, LatticesAndDuplicatesHaveNone) {
  Cloud duplicates;
  duplicates.points.assign(20000, {1, 2, 3});
  EXPECT_EQ(run(duplicates).removed, 0);
  Cloud ring;  // every point has the same neighbourhood
  for (int i = 0; i < 3600; ++i) {
    const double a = i * 3.14159265358979 / 1800;
    ring.points.push_back(Eigen::Vector3d(std::cos(a), std::sin(a), 0).cast<float>());
  }
  EXPECT_EQ(run(ring, {2, 3.0}).removed, 0);
}

TEST(Outliers, FewPointsAreHandedOn) {
  EXPECT_EQ(run({}).cloud.size(), 0U);
  Cloud cloud;
  for (int i = 0; i < 16; ++i) cloud.points.emplace_back(static_cast<float>(i * i), 0, 0);
  EXPECT_EQ(run(cloud).cloud.size(), 16U);
  EXPECT_EQ(run(cloud, {1, 1.0}).removed, 3);  // gaps 1, 1, 3, 5 … 29: mean 14.1, deviation 8.8
}

TEST(Outliers, ShufflingKeepsTheSamePoints) {
  const Cloud cloud = plane_with_outliers(100);
  std::vector<std::uint32_t> indices(cloud.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>((i * 7919) % indices.size());
  EXPECT_EQ(run(cloud).removed, run(select(cloud, indices)).removed);
}

TEST(Outliers, SameBytesOnAnyNumberOfThreads) {
  const Cloud cloud = plane_with_outliers(500);
  std::string one;
  tbb::task_arena(1).execute([&] { one = content_hash(run(cloud).cloud); });
  for (const int threads : {2, 4})
    tbb::task_arena(threads).execute([&] { EXPECT_EQ(content_hash(run(cloud).cloud), one); });
}

}  // namespace
}  // namespace atrium::filter::outliers_test
