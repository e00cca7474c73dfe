#include "modules/plane/register_positions.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

namespace atrium::plane::register_positions_test {
namespace {

using Eigen::Vector3d;

const Vector3d room(4, 3, 2.5);

std::shared_ptr<const Cloud> registered(const Cloud& cloud) {
  Context context;
  return RegisterPositions::run({input(cloud)}, {}, context).cloud;
}

/// Adds what a position inside sees of a box: points of the chosen pairs of faces, moved by the position's drift.
void scan(Cloud& cloud, const Vector3d& drift, std::size_t points, const std::vector<int>& axes = {0, 1, 2}) {
  Random random(cloud.sensors.size() + 1);
  const auto position = static_cast<std::uint16_t>(cloud.sensors.size());
  const Vector3d stand = Vector3d(1 + 2 * random.uniform(), 1 + random.uniform(), 1.2);
  cloud.sensors.emplace_back((stand + drift).cast<float>());
  for (std::size_t i = 0; i < points; ++i) {
    Vector3d p = Vector3d(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(room);
    const int axis = axes[i % axes.size()];
    p[axis] = random.uniform() < 0.5 ? 0 : room[axis];
    p[axis] += 0.001 * random.normal();
    cloud.points.emplace_back((p + drift).cast<float>());
    cloud.source.push_back(position);
  }
}

Cloud drifting(std::size_t positions, std::size_t points) {
  Random random(3);
  Cloud cloud;
  for (std::size_t k = 0; k < positions; ++k) {
    const Vector3d drift(random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04));
    scan(cloud, k == 0 ? Vector3d::Zero() : drift, points);
  }
  return cloud;
}

/// The distances of the points to the nearest face of the box: the most but for one point in 1000.
double furthest_from_faces(const Cloud& cloud) {
  std::vector<double> distances;
  for (const auto& point : cloud.points) {
    const Vector3d p = point.cast<double>();
    distances.push_back(std::min(p.cwiseAbs().minCoeff(), (p - room).cwiseAbs().minCoeff()));
  }
  std::sort(distances.begin(), distances.end());
  return distances[distances.size() * 999 / 1000];
}

TEST(RegisterPositions, DriftIsTakenOutAndTheFirstPositionStays) {
  const Cloud cloud = drifting(5, 6000);
  EXPECT_GT(furthest_from_faces(cloud), 0.02);
  const auto result = registered(cloud);
  EXPECT_LT(furthest_from_faces(*result), 0.005);
  for (std::size_t i = 0; i < 6000; ++i) ASSERT_EQ(result->points[i], cloud.points[i]);
  EXPECT_EQ(result->sensors[0], cloud.sensors[0]);
  for (std::size_t k = 1; k < 5; ++k) {  // a sensor moves with its points
    const Eigen::Vector3f moved = result->points[6000 * k] - cloud.points[6000 * k];
    EXPECT_LT((result->sensors[k] - cloud.sensors[k] - moved).norm(), 1e-5F);
  }
}

TEST(RegisterPositions, ManyPositions) {
  const auto result = registered(drifting(80, 1200));
  EXPECT_LT(furthest_from_faces(*result), 0.006);
}

TEST(RegisterPositions, NothingMovesAlongADirectionThatNothingHolds) {
  Cloud cloud;
  scan(cloud, Vector3d::Zero(), 6000, {2});
  scan(cloud, {0.01, 0.02, 0.03}, 6000, {2});
  const auto result = registered(cloud);
  const Eigen::Vector3f moved = result->points[6000] - cloud.points[6000];
  EXPECT_NEAR(moved.x(), 0, 1e-3);
  EXPECT_NEAR(moved.y(), 0, 1e-3);
  EXPECT_NEAR(moved.z(), -0.03, 1e-3);
}

TEST(RegisterPositions, APositionThatSharesNothingStays) {
  Cloud cloud = drifting(2, 6000);
  scan(cloud, {30, 0, 0}, 6000);
  scan(cloud, {0, 0, 0}, 20);  // too few points for planes
  const auto result = registered(cloud);
  for (std::size_t i = 12000; i < cloud.size(); ++i) ASSERT_EQ(result->points[i], cloud.points[i]);
}

TEST(RegisterPositions, WhatAgreesOrSaysNothingIsHandedOn) {
  Cloud agreeing;
  for (int k = 0; k < 3; ++k) scan(agreeing, Vector3d::Zero(), 3000);
  Cloud one;
  scan(one, Vector3d::Zero(), 3000);
  Cloud unknown = drifting(3, 3000);
  unknown.source.clear();
  for (const auto& cloud : {agreeing, one, unknown, Cloud{}}) {
    const auto shared = std::make_shared<const Cloud>(cloud);
    Context context;
    EXPECT_EQ(RegisterPositions::run({shared}, {}, context).cloud, shared);
  }
}

TEST(RegisterPositions, SameBytesOnAnyNumberOfThreads) {
  const Cloud cloud = drifting(4, 3000);
  std::string one;
  tbb::task_arena(1).execute([&] { one = content_hash(*registered(cloud)); });
  tbb::task_arena(3).execute([&] { EXPECT_EQ(content_hash(*registered(cloud)), one); });
}

}  // namespace
}  // namespace atrium::plane::register_positions_test
