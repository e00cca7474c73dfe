#include "modules/register/gicp.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "modules/geometry/point_tree.hpp"
#include "modules/io/read_scan.hpp"
#include "tests/bench/box_flat.hpp"

namespace atrium::registration::gicp_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The scene as a scanner at a pose sees it: that pose is the cloud's zero, and its sensor.
Cloud seen_from(const Cloud& scene, const Eigen::Isometry3d& pose) {
  Cloud cloud;
  const Eigen::Isometry3d back = pose.inverse();
  for (const auto& p : scene.points) cloud.points.push_back((back * p.cast<double>()).cast<float>());
  for (const auto& n : scene.normals) cloud.normals.push_back((back.rotation() * n.cast<double>()).cast<float>());
  cloud.sensors = {Eigen::Vector3f::Zero()};
  return cloud;
}

Eigen::Isometry3d pose(double x, double y, double z, double yaw) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw * degree, Eigen::Vector3d::UnitZ());
}

/// One L-shaped room, so that only one pose fits: two rooms of the flat with the wall between them left out.
Cloud scene(std::uint64_t seed) {
  const Cloud flat = bench::box_flat(120000, 0.004, seed);
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < flat.size(); ++i)
    if (flat.source[i] < 2 || (flat.source[i] == 2 && flat.points[i].y() > 4.3F)) indices.push_back(i);
  return select(flat, indices);
}

void expect_pose(const Transform& found, const Eigen::Isometry3d& truth, double metres, double degrees) {
  EXPECT_LT((found.translation - truth.translation()).norm(), metres);
  EXPECT_LT(Eigen::AngleAxisd(found.rotation.transpose() * truth.rotation()).angle() / degree, degrees);
  EXPECT_NEAR(found.rotation.determinant(), 1, 1e-9);
}

TEST(Gicp, FindsAKnownPoseAndJoinsTheScans) {
  const Eigen::Isometry3d a = pose(3, 2, 1.5, 0), b = pose(3.2, 2.1, 1.45, 4);
  Context context;
  Inputs<Cloud> clouds{input(seen_from(scene(1), a)), input(seen_from(scene(2), b))};
  const auto out = Gicp::run({clouds}, {}, context);
  ASSERT_EQ(out.poses.transforms.size(), 2U);
  EXPECT_EQ(out.poses.transforms[0].rotation, Eigen::Matrix3d::Identity());
  EXPECT_LT(out.poses.transforms[0].translation.norm(), 1e-12);
  expect_pose(out.poses.transforms[1], a.inverse() * b, 0.005, 0.1);
  ASSERT_EQ(out.cloud.size(), clouds[0]->size() + clouds[1]->size());
  ASSERT_EQ(out.cloud.sensors.size(), 2U);
  EXPECT_LT((out.cloud.sensors[1].cast<double>() - (a.inverse() * b).translation()).norm(), 0.005);
  EXPECT_EQ(out.cloud.source.front(), 0);
  EXPECT_EQ(out.cloud.source.back(), 1);
  ASSERT_EQ(out.metrics.values.size(), 3U);
  EXPECT_EQ(out.metrics.values[0].name, "register.1.overlap");
  EXPECT_GT(out.metrics.values[0].value, 0.99);
  EXPECT_EQ(out.cloud.normals.size(), out.cloud.size());
}

TEST(Gicp, OriginsAreKeptToTheMillimetre) {
  Context context;
  Cloud a = seen_from(scene(1), pose(3, 2, 1.5, 0)), b = seen_from(scene(2), pose(3.1, 2.1, 1.5, 0));
  const Eigen::Vector3d utm(500000, 5400000, 100);
  a.origin = utm;
  b.origin = utm + Eigen::Vector3d(10, 0, 0);
  for (auto& p : b.points) p.x() -= 10;  // the same places about another origin
  const auto out = Gicp::run({{input(a), input(b)}}, {}, context);
  EXPECT_EQ(out.cloud.origin, utm);
  const Transform& t = out.poses.transforms[1];
  const Eigen::Vector3d sensor = t.rotation * (utm + Eigen::Vector3d(0, 0, 0)) + t.translation;
  EXPECT_LT((sensor - (utm + Eigen::Vector3d(0.1, 0.1, 0))).norm(), 0.005);
}

TEST(Gicp, StartPosesBringScansThatStandFarApartTogether) {
  const Eigen::Isometry3d a = pose(3, 2, 1.5, 0), b = pose(7, 2.5, 1.3, 130);
  const Eigen::Isometry3d truth = a.inverse() * b;
  Context context;
  const Inputs<Cloud> clouds{input(seen_from(scene(1), a)), input(seen_from(scene(2), b))};
  Gicp::Params params;
  params.initial = {3.9, 0.6, -0.1, 133};
  expect_pose(Gicp::run({clouds}, params, context).poses.transforms[1], truth, 0.005, 0.1);
  params.initial.clear();
  params.coarse = Coarse::yaw_search;
  expect_pose(Gicp::run({clouds}, params, context).poses.transforms[1], truth, 0.005, 0.1);
}

TEST(Gicp, ColumnsThatNotAllHaveAreDropped) {
  Context context;
  Cloud a = seen_from(scene(1), pose(3, 2, 1.5, 0));
  Cloud b = a;
  b.normals.clear();
  b.sensors.clear();
  const auto out = Gicp::run({{input(a), input(b)}}, {}, context);
  EXPECT_TRUE(out.cloud.normals.empty());
  EXPECT_TRUE(out.cloud.sensors.empty());
  EXPECT_TRUE(out.cloud.source.empty());
}

TEST(Gicp, BadInputs) {
  Context context;
  const auto scan = input(seen_from(scene(1), pose(3, 2, 1.5, 0)));
  EXPECT_EQ(Gicp::run({{scan}}, {}, context).cloud.size(), scan->size());
  EXPECT_EQ(Gicp::run({{input(Cloud{})}}, {}, context).cloud.size(), 0U);
  EXPECT_THROW(Gicp::run({{scan, input(Cloud{})}}, {}, context), Error);
  Cloud duplicates;
  duplicates.points.assign(1000, {1, 2, 3});
  EXPECT_THROW(Gicp::run({{scan, input(duplicates)}}, {}, context), Error);
  Gicp::Params params;
  params.initial = {1, 2, 3};
  EXPECT_THROW(Gicp::run({{scan, scan}}, params, context), Error);
}

/// Median distance between neighbours of different real scans, after registration.
void expect_scans_to_fit(const std::string& first, const std::string& second, Coarse coarse, double least_overlap) {
  const std::filesystem::path folder = std::filesystem::path(ATRIUM_SOURCE_DIR) / "../shared/scans";
  if (!std::filesystem::exists(folder / first)) GTEST_SKIP() << "no scans at " << folder;
  Context context;
  Inputs<Cloud> clouds;
  for (const auto& name : {first, second}) {
    io::ReadScan::Params read;
    read.path = {{(folder / name).string()}};
    clouds.push_back(input(io::ReadScan::run(read, context).cloud));
  }
  Gicp::Params params;
  params.coarse = coarse;
  const auto out = Gicp::run({clouds}, params, context);
  for (const auto& m : out.metrics.values) ::testing::Test::RecordProperty(m.name, std::to_string(m.value));
  EXPECT_GT(out.metrics.values[0].value, least_overlap);
  EXPECT_LT(out.metrics.values[1].value, 0.06);
}

TEST(Gicp, RealScansOfAFlat) {
  expect_scans_to_fit("lidar_flat/cloud_0.ply", "lidar_flat/cloud_1.ply", Coarse::none, 0.8);
}
TEST(Gicp, RealScansOfARoom) {
  expect_scans_to_fit("lidar_room/room_scan1.pcd", "lidar_room/room_scan2.pcd", Coarse::yaw_search, 0.6);
}

}  // namespace
}  // namespace atrium::registration::gicp_test
