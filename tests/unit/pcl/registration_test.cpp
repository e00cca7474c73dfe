#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "modules/pcl/gicp.hpp"
#include "modules/pcl/ndt.hpp"
#include "modules/register/gicp.hpp"
#include "tests/bench/box_flat.hpp"

namespace atrium::pcl_nodes::registration_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// An L-shaped room as a scanner at a pose sees it: that pose is the cloud's zero.
Cloud scan(std::uint64_t seed, const Eigen::Isometry3d& pose) {
  const Cloud flat = bench::box_flat(80000, 0.004, seed);
  Cloud cloud;
  for (std::uint32_t i = 0; i < flat.size(); ++i)
    if (flat.source[i] < 2 || (flat.source[i] == 2 && flat.points[i].y() > 4.3F))
      cloud.points.push_back((pose.inverse() * flat.points[i].cast<double>()).cast<float>());
  cloud.sensors = {Eigen::Vector3f::Zero()};
  return cloud;
}

Eigen::Isometry3d pose(double x, double y, double yaw) {
  return Eigen::Translation3d(x, y, 1.5) * Eigen::AngleAxisd(yaw * degree, Eigen::Vector3d::UnitZ());
}

template <class Node>
auto run(const Inputs<Cloud>& clouds, typename Node::Params params = {}) {
  Context context;
  return Node::run({clouds}, params, context);
}

const Eigen::Isometry3d first = pose(3, 2, 0), second = pose(3.2, 2.1, 4);

Inputs<Cloud> scans() { return {input(scan(1, first)), input(scan(2, second))}; }

/// Whether the second scan's pose is right.
void expect_pose(const Poses& poses, double metres, double degrees) {
  ASSERT_EQ(poses.transforms.size(), 2U);
  const Eigen::Isometry3d truth = first.inverse() * second;
  EXPECT_LT((poses.transforms[1].translation - truth.translation()).norm(), metres);
  EXPECT_LT(Eigen::AngleAxisd(poses.transforms[1].rotation.transpose() * truth.rotation()).angle() / degree, degrees);
}

TEST(PclGicp, FindsThePoseThatOursFinds) {
  const auto out = run<Gicp>(scans());
  expect_pose(out.poses, 0.005, 0.1);
  EXPECT_EQ(content_hash(out.cloud), content_hash(run<registration::Gicp>(scans()).cloud));
}

TEST(PclGicp, NeedsAFewRounds) {
  Gicp::Params params;
  params.iterations = 1;
  params.optimizer_iterations = 1;
  const auto out = run<Gicp>(scans(), params);
  EXPECT_GT((out.poses.transforms[1].translation - (first.inverse() * second).translation()).norm(), 0.005);
}

TEST(PclNdt, FindsAKnownPose) {
  const auto out = run<Ndt>(scans());
  expect_pose(out.poses, 0.02, 0.3);
  EXPECT_GT(out.metrics.values.at(0).value, 0.95);
  EXPECT_EQ(out.cloud.size(), scans()[0]->size() + scans()[1]->size());
}

TEST(PclNdt, TakesAStartPoseAndACoarserGrid) {
  Ndt::Params params;
  params.resolution = 1;
  params.initial = {0.25, 0.05, 0, 5};
  expect_pose(run<Ndt>(scans(), params).poses, 0.03, 0.5);
}

template <class Node>
class PclRegistration : public testing::Test {};
using Nodes = testing::Types<Gicp, Ndt>;
TYPED_TEST_SUITE(PclRegistration, Nodes);

/// What a run says.
class Listener : public ContextHost {
 public:
  void log(Level level, std::string_view text) override {
    if (level == Level::warning) warnings += std::string(text) + "\n";
  }
  std::string warnings;
};

TYPED_TEST(PclRegistration, SaysWhenItEndedAtItsLimit) {
  typename TypeParam::Params params;
  for (const std::int64_t limit : {2, 100}) {
    const auto host = std::make_shared<Listener>();
    Context context(1, host);
    params.iterations = limit;
    TypeParam::run({scans()}, params, context);
    EXPECT_EQ(host->warnings.find("did not converge") != std::string::npos, limit == 2) << limit << host->warnings;
  }
}

TYPED_TEST(PclRegistration, BadInputs) {
  const auto one = input(scan(1, first));
  EXPECT_EQ(run<TypeParam>({one}).cloud.size(), one->size());
  EXPECT_EQ(run<TypeParam>({input(Cloud{})}).cloud.size(), 0U);
  EXPECT_THROW(run<TypeParam>({one, input(Cloud{})}), Error);
  typename TypeParam::Params params;
  params.initial = {1, 2, 3};
  EXPECT_THROW(run<TypeParam>({one, one}, params), Error);
}

}  // namespace
}  // namespace atrium::pcl_nodes::registration_test
