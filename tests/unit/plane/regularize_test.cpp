#include "modules/plane/regularize.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/rooms.hpp"

namespace atrium::plane::regularize_test {
namespace {

using atrium::test::Rooms;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double degree = M_PI / 180;

PlanePrimitives regular(const PlanePrimitives& planes, const Regularize::Params& params = {}) {
  Context context;
  return Regularize::run({input(planes)}, params, context).planes;
}

/// A wall of `length` × 2.5 m about `middle` whose normal is (cos heading, sin heading, 0) tilted by `lean`.
void add_wall(Rooms& rooms, const Vector3d& middle, double heading, double length, double lean = 0) {
  const Vector3d along(-std::sin(heading), std::cos(heading), 0);
  const Vector3d up = AngleAxisd(lean, along) * Vector3d::UnitZ();
  rooms.add(middle - along * length / 2 - up * 1.25, along * length, up * 2.5, along.cross(up));
}
double angle(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) / degree; }

TEST(Regularize, NearlyUprightAndLevelPlanesBecomeSo) {
  Rooms rooms;
  add_wall(rooms, {0, 0, 1.25}, 0.3, 2, 0.2 * degree);
  rooms.add({0, 0, 0}, {3, 0, 0.005}, {0, 3, -0.005}, {-0.005 / 3, 0.005 / 3, 1});
  rooms.add({0, 0, 2.5}, {3, 0, 0.005}, {0, 3, 0}, {0.005 / 3, 0, -1});
  const auto out = regular(rooms.unsorted()).primitives;
  EXPECT_EQ(out[0].plane.normal.z(), 0);
  EXPECT_EQ(out[1].plane.normal, Vector3d(0, 0, 1));
  EXPECT_EQ(out[2].plane.normal, Vector3d(0, 0, -1));
  // About the middle of their points.
  EXPECT_NEAR(-out[1].plane.offset, 0, 1e-4);
  EXPECT_NEAR(out[2].plane.offset, 2.5025, 1e-4);
  EXPECT_NEAR(out[0].plane.offset, 0, 1e-4);
}

TEST(Regularize, NoPlaceMovesByMoreThanTheDistance) {
  Rooms rooms;
  // 1.5 cm at the ends of 3 m: more than the 1 cm that exact planes are moved by.
  rooms.add({0, 0, 0}, {3, 0, 0.03}, {0, 3, 0}, {-0.01, 0, 1});
  add_wall(rooms, {0, 0, 1.25}, 0, 4);
  add_wall(rooms, {3, 0, 1.25}, 90.5 * degree, 4);  // 1.7 cm at its ends
  const auto before = rooms.unsorted();
  auto out = regular(before).primitives;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(angle(out[i].plane.normal, before.primitives[i].plane.normal), 0.29) << i;
  EXPECT_EQ(out[0].plane.normal, before.primitives[0].plane.normal);
  out = regular(before, {.distance = 0.03}).primitives;
  EXPECT_EQ(out[0].plane.normal, Vector3d(0, 0, 1));
  EXPECT_NEAR(out[1].plane.normal.dot(out[2].plane.normal), 0, 1e-12);
  // The angle bounds small pieces.
  Rooms small;
  small.add({0, 0, 0}, {0.1, 0, 0.01}, {0, 0.1, 0}, {-0.1, 0, 1});  // 5.7°
  EXPECT_NE(regular(small.unsorted()).primitives[0].plane.normal, Vector3d(0, 0, 1));
  EXPECT_EQ(regular(small.unsorted(), {.angle = 6}).primitives[0].plane.normal, Vector3d(0, 0, 1));
}

TEST(Regularize, WallsOfOneFamilyAreExactlyParallelOrPerpendicular) {
  Rooms rooms;
  const double turn = 17 * degree;
  add_wall(rooms, {0, 0, 1.25}, turn, 5);
  add_wall(rooms, {4, 0, 1.25}, turn + M_PI + 0.1 * degree, 5);
  add_wall(rooms, {2, 2, 1.25}, turn + M_PI / 2 - 0.1 * degree, 4);
  add_wall(rooms, {2, -2, 1.25}, turn - M_PI / 2 + 0.2 * degree, 3);
  add_wall(rooms, {9, 9, 1.25}, turn + 30 * degree, 3);  // another family
  const auto out = regular(rooms.unsorted()).primitives;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double c = std::abs(out[i].plane.normal.dot(out[k].plane.normal));
      EXPECT_LT(std::min(c, 1 - c), 1e-12);
    }
  EXPECT_NEAR(angle(out[4].plane.normal, {std::cos(turn + 30 * degree), std::sin(turn + 30 * degree), 0}), 0, 1e-4);
  // The mean direction, weighted by area, is nearer to the largest.
  EXPECT_LT(angle(out[0].plane.normal, {std::cos(turn), std::sin(turn), 0}), 0.1);
}

TEST(Regularize, TheSidesOfARoofTakeOneTilt) {
  Rooms rooms;
  const double tilt = 35 * degree;
  const auto side = [&](double sign, double t, double length) {
    const Vector3d down(sign * std::cos(t), 0, -std::sin(t));
    rooms.add({0, 0, 4}, down * 3, {0, length, 0}, {-sign * std::sin(t), 0, -std::cos(t)});
  };
  side(1, tilt, 5);
  side(-1, tilt + 0.15 * degree, 4);
  const auto out = regular(rooms.unsorted()).primitives;
  EXPECT_NEAR(out[0].plane.normal.z(), out[1].plane.normal.z(), 1e-12);
  EXPECT_NEAR(out[0].plane.normal.x(), -out[1].plane.normal.x(), 1e-12);
}

TEST(Regularize, TheTiltOfARoofIsTheMeanOfItsSides) {
  // Two sides alike but for their tilts, which noise made 0.2 degrees different.
  Rooms rooms;
  const double a = 45 * degree, b = 45.2 * degree;
  rooms.add({0, 0, 0}, {4, 0, 0}, {0, 2 * std::cos(a), 2 * std::sin(a)}, {0, std::sin(a), -std::cos(a)});
  rooms.add({0, 6, 0}, {4, 0, 0}, {0, -2 * std::cos(b), 2 * std::sin(b)}, {0, -std::sin(b), -std::cos(b)});
  for (const auto& primitive : regular(rooms.unsorted()).primitives)
    EXPECT_NEAR(std::acos(-primitive.plane.normal.z()) / degree, 45.1, 1e-3);
}

TEST(Regularize, NothingToDo) {
  EXPECT_TRUE(regular(PlanePrimitives{}).primitives.empty());
  PlanePrimitives planes = Rooms().floor(0, 0, 3, 3).unsorted();
  planes.primitives.push_back({{{0.6, 0, 0.8}, 1}, {}, 0.5});  // without points: left as it is
  const auto out = regular(planes);
  ASSERT_EQ(out.primitives.size(), 2U);
  EXPECT_EQ(out.primitives[1].plane.normal, Vector3d(0.6, 0, 0.8));
  EXPECT_EQ(out.primitives[1].residual, 0.5);
  EXPECT_EQ(out.primitives[0].plane.normal, Vector3d(0, 0, 1));
}

// Any scene: planes stay within the distance, keep their side and points, and their residual is that of their points.
RC_GTEST_PROP(Regularize, NeverMovesAPlaneOutOfItsReach, (std::uint32_t seed)) {
  Random random(seed);
  Rooms rooms;
  rooms.spacing = 0.3;
  for (std::uint64_t i = 0; i < 2 + random.index(12); ++i) {
    const Vector3d middle(random.uniform(-5, 5), random.uniform(-5, 5), 1.25);
    const double heading =
        random.uniform() < 0.6 ? 90 * degree * static_cast<double>(random.index(4)) : random.uniform(0, 6);
    add_wall(rooms, middle, heading + random.uniform(-1, 1) * degree, random.uniform(0.5, 6),
             random.uniform() < 0.7 ? random.uniform(-1, 1) * degree : random.uniform(-1, 1));
  }
  const auto before = rooms.unsorted();
  const auto out = regular(before, {.distance = 0.02});
  for (std::size_t i = 0; i < out.primitives.size(); ++i) {
    const auto &a = before.primitives[i], &b = out.primitives[i];
    RC_ASSERT(a.inliers == b.inliers);
    RC_ASSERT(std::abs(b.plane.normal.norm() - 1) < 1e-9);
    double squares = 0, most = 0;
    for (const auto k : b.inliers) {
      const double d = b.plane.signed_distance(before.cloud->points[k].cast<double>());
      squares += d * d;
      most = std::max(most, std::abs(d));
    }
    // Upright, in a family, with a tilt: up to three turns, each measured from where the plane was before it.
    RC_ASSERT(most <= 3 * 0.02 + 1e-4);
    RC_ASSERT(angle(a.plane.normal, b.plane.normal) <= 15.01);
    RC_ASSERT(std::abs(b.residual - std::sqrt(squares / static_cast<double>(b.inliers.size()))) < 1e-4);
  }
}

}  // namespace
}  // namespace atrium::plane::regularize_test
