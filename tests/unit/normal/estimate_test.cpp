#include "modules/normal/estimate.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace atrium::normal::estimate_test {
namespace {

constexpr Method all_methods[] = {Method::voxels, Method::radius, Method::neighbours};

Cloud run(const Cloud& cloud, Method method) {
  Context context;
  Estimate::Params params;
  params.method = method;
  return Estimate::run({input(cloud)}, params, context).cloud;
}

/// A rectangle corner + u a + v b with noise along its normal; the true normals stand in the cloud.
void add_rectangle(Cloud& cloud, std::size_t count, const Eigen::Vector3d& corner, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b, double noise, std::uint64_t seed) {
  Random random(seed);
  const Eigen::Vector3d n = a.cross(b).normalized();
  for (std::size_t i = 0; i < count; ++i) {
    const double u = random.uniform(), v = random.uniform();
    cloud.points.push_back((corner + u * a + v * b + noise * random.normal() * n).cast<float>());
    cloud.normals.push_back(n.cast<float>());
  }
}

double angle(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::acos(std::min(1.0, std::abs(static_cast<double>(a.dot(b))))) * 180 / std::numbers::pi;
}

double share_wrong(const Cloud& found, const Cloud& truth, double limit) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < found.size(); ++i) wrong += angle(found.normals[i], truth.normals[i]) > limit ? 1 : 0;
  return static_cast<double>(wrong) / static_cast<double>(found.size());
}

void expect_unit(const Cloud& cloud) {
  ASSERT_EQ(cloud.normals.size(), cloud.points.size());
  for (const auto& n : cloud.normals) ASSERT_NEAR(n.norm(), 1, 1e-5);
}

TEST(NormalEstimate, PlanesInAnyAttitudeAreExactWithoutNoise) {
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Vector3d a = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Eigen::Vector3d b = a.cross(Eigen::Vector3d(random.normal(), random.normal(), random.normal())).normalized();
    Cloud plane;
    add_rectangle(plane, 5000, {1, 2, 3}, a, b, 0, 1);
    for (const Method method : all_methods) EXPECT_EQ(share_wrong(run(plane, method), plane, 0.05), 0);
  }
}

TEST(NormalEstimate, BothSidesOfAThinWallKeepTheirNormalsUnderNoise) {
  Cloud cloud;  // two faces 12 cm apart, 13,000 points/m², 8 mm noise
  add_rectangle(cloud, 39000, {0, 0, 0}, {2, 0.3, 0}, {0, 0, 1.5}, 0.008, 1);
  add_rectangle(cloud, 39000, {0, 0.12, 0}, {2, 0.3, 0}, {0, 0, 1.5}, 0.008, 2);
  EXPECT_LT(share_wrong(run(cloud, Method::voxels), cloud, 5), 0.005);
  EXPECT_LT(share_wrong(run(cloud, Method::voxels), cloud, 10), 0.0005);
  EXPECT_LT(share_wrong(run(cloud, Method::radius), cloud, 10), 0.03);
  EXPECT_GT(share_wrong(run(cloud, Method::neighbours), cloud, 10), 0.5);  // a fixed count sees noise only
}

TEST(NormalEstimate, VoxelsKeepEdgesSharp) {
  Cloud corner;
  add_rectangle(corner, 20000, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.002, 1);
  add_rectangle(corner, 20000, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.002, 2);
  add_rectangle(corner, 20000, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 0.002, 3);
  EXPECT_LT(share_wrong(run(corner, Method::voxels), corner, 10), 0.01);
  EXPECT_GT(share_wrong(run(corner, Method::radius), corner, 10), 0.03);  // rounds them off
}

TEST(NormalEstimate, NormalsOfASphereAreRadial) {
  Random random(1);
  Cloud sphere;
  for (int i = 0; i < 40000; ++i) {
    const Eigen::Vector3d n = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    sphere.points.push_back((n * 0.5).cast<float>());
    sphere.normals.push_back(n.cast<float>());
  }
  EXPECT_EQ(share_wrong(run(sphere, Method::radius), sphere, 2), 0);
  EXPECT_LT(share_wrong(run(sphere, Method::voxels), sphere, 10), 0.02);
}

TEST(NormalEstimate, SidesFollowTheNormalsThatWereThere) {
  Cloud floor;
  add_rectangle(floor, 2000, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 0, 1);  // normals down
  for (const Method method : all_methods) {
    for (const auto& n : run(floor, method).normals) EXPECT_LT(n.z(), -0.999F);
    Cloud bare = floor;
    bare.normals.clear();
    for (const auto& n : run(bare, method).normals) EXPECT_GT(n.z(), 0.999F);
  }
}

TEST(NormalEstimate, ShufflingThePointsChangesNoNormal) {
  Cloud cloud;
  add_rectangle(cloud, 20000, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.004, 1);
  add_rectangle(cloud, 20000, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.004, 2);
  std::vector<std::uint32_t> indices(cloud.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>((i * 7919) % indices.size());
  for (const Method method : all_methods) {
    const Cloud a = select(run(cloud, method), indices);
    const Cloud b = run(select(cloud, indices), method);
    EXPECT_LT(share_wrong(a, b, 0.2), 1e-3);  // sums in another order
  }
}

TEST(NormalEstimate, SameBytesOnAnyNumberOfThreads) {
  Cloud cloud;
  add_rectangle(cloud, 60000, {0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.004, 1);
  add_rectangle(cloud, 60000, {0, 0, 0}, {0, 2, 0}, {0, 0, 1}, 0.004, 2);
  for (const Method method : all_methods) {
    std::string one;
    tbb::task_arena(1).execute([&] { one = content_hash(run(cloud, method)); });
    for (const int threads : {2, 4})
      tbb::task_arena(threads).execute([&] { EXPECT_EQ(content_hash(run(cloud, method)), one); });
  }
}

TEST(NormalEstimate, WhateverThePointsNormalsAreUnit) {
  Random random(8);
  std::vector<Cloud> clouds(7);
  clouds[1].points = {{1, 2, 3}};
  clouds[2].points = {{1, 2, 3}, {2, 2, 3}};
  clouds[3].points.assign(20000, {1, 2, 3});                                                          // duplicates
  for (int i = 0; i < 1000; ++i) clouds[4].points.emplace_back(0.01F * static_cast<float>(i), 0, 0);  // a line
  for (int i = 0; i < 500; ++i)
    clouds[5].points.push_back(Eigen::Vector3d(random.uniform(0, 9), random.uniform(0, 9), 1).cast<float>());  // sparse
  add_rectangle(clouds[6], 3000, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.001, 1);
  clouds[6].points.emplace_back(1e6F, 1e6F, -1e6F);  // a wild point
  clouds[6].normals.clear();
  for (const Cloud& cloud : clouds)
    for (const Method method : all_methods) expect_unit(run(cloud, method));
  for (const auto& n : run(clouds[4], Method::voxels).normals) EXPECT_NEAR(n.x(), 0, 1e-5);
  for (const auto& n : run(clouds[5], Method::voxels).normals) EXPECT_NEAR(std::abs(n.z()), 1, 1e-5);
}

}  // namespace
}  // namespace atrium::normal::estimate_test
