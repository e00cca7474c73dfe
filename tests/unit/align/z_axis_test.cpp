#include "modules/align/z_axis.hpp"

#include <gtest/gtest.h>

#include "modules/align/xy_plane.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::align::z_axis_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

Transform pose(double yaw_deg, double tilt_deg) {
  Transform t;
  const double rad = std::numbers::pi / 180;
  t.rotation =
      (AngleAxisd(tilt_deg * rad, Vector3d(1, 2, 0).normalized()) * AngleAxisd(yaw_deg * rad, Vector3d::UnitZ()))
          .toRotationMatrix();
  t.translation = {3, -2, 7};
  return t;
}

double degrees_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

TEST(AlignZAxis, UndoesATilt) {
  Context context;
  const PlanePrimitives room = test::box_room().planes();
  for (const double tilt : {0.0, 2.5, 20.0, 50.0}) {
    const auto out = ZAxis::run({input(transformed(room, pose(23, tilt))), {}}, {}, context);
    for (std::size_t i = 0; i < room.primitives.size(); ++i) {
      const double before = room.primitives[i].plane.normal.z();
      EXPECT_NEAR(out.planes.primitives[i].plane.normal.z(), before, 1e-9) << tilt;
    }
  }
}

TEST(AlignZAxis, TakesAnotherAxisForUp) {
  Context context;
  const PlanePrimitives room = test::box_room().planes();
  Transform camera;  // y down, z forward
  camera.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const auto scan = input(transformed(transformed(room, pose(23, 4)), camera));
  EXPECT_THROW(ZAxis::run({scan, {}}, {.up = {0, 0, 0}}, context), Error);
  const auto out = ZAxis::run({scan, {}}, {.up = {0, -2, 0}}, context);
  for (std::size_t i = 0; i < room.primitives.size(); ++i)
    EXPECT_NEAR(out.planes.primitives[i].plane.normal.z(), room.primitives[i].plane.normal.z(), 1e-9);
  EXPECT_NEAR(out.transform.rotation.determinant(), 1, 1e-12);
}

TEST(AlignZAxis, TheLargerListDecidesNotTheLargerPlane) {
  Context context;
  test::Rooms rooms;
  // Two ceilings, exactly level, against one floor that is larger but tilted by 2°: D has two planes, U one.
  const double slope = std::tan(2 * std::numbers::pi / 180);
  rooms.ceiling(0, 0, 4, 3).ceiling(5, 0, 7, 3).add({0, 0, 0}, {8, 0, 8 * slope}, {0, 3, 0}, {-slope, 0, 1});
  const auto out = ZAxis::run({input(rooms.planes()), {}}, {}, context);
  EXPECT_NEAR((out.transform.rotation - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  // With a second floor the lists are equal in length, which is D as printed; with a third, U.
  rooms.floor(10, 0, 11, 1).floor(12, 0, 13, 1);
  const auto up = ZAxis::run({input(rooms.planes()), {}}, {}, context);
  EXPECT_NEAR(degrees_between(up.transform.rotation * Vector3d::UnitZ(), Vector3d::UnitZ()), 2.0, 1e-6);
}

TEST(AlignZAxis, TurnsDownFacingPlanesDown) {
  Context context;
  test::Rooms rooms;
  rooms.ceiling(0, 0, 4, 3);
  const auto out = ZAxis::run({input(transformed(rooms.planes(), pose(0, 10))), {}}, {}, context);
  EXPECT_NEAR(out.planes.primitives[0].plane.normal.z(), -1, 1e-12);
}

TEST(AlignZAxis, BelievesPointsNormalsBeforeThePlanesSign) {
  Context context;
  test::Rooms rooms;
  rooms.ceiling(0, 0, 4, 3);
  PlanePrimitives planes = transformed(rooms.planes(), pose(0, 10));
  Plane& plane = planes.primitives[0].plane;
  plane = {-plane.normal, -plane.offset};
  const auto out = ZAxis::run({input(planes), {}}, {}, context);
  EXPECT_NEAR(out.planes.primitives[0].plane.normal.z(), 1, 1e-12);  // its points' normals look down
  EXPECT_LT(out.planes.cloud->normals[0].z(), -0.999);
}

TEST(AlignZAxis, PlanesStayOnTheirPointsFarFromZero) {
  Context context;
  const PlanePrimitives room = test::box_room().origin({500000, 5400000, 300}).planes();
  const auto out = ZAxis::run({input(transformed(room, pose(23, 2.5))), {}}, {}, context);
  for (const auto& primitive : out.planes.primitives)
    for (const auto i : primitive.inliers)
      EXPECT_NEAR(primitive.plane.signed_distance(out.planes.cloud->points[i].cast<double>()), 0, 1e-5);
}

TEST(AlignZAxis, TransformLeadsFromTheInputFrameOverEarlierSteps) {
  Context context;
  const PlanePrimitives room = test::box_room().origin({500000, 5400000, 300}).planes();
  const Transform earlier = pose(10, 5);
  const auto out = ZAxis::run({input(transformed(room, earlier)), input(earlier)}, {}, context);
  const Transform back = inverse(out.transform);
  const auto& cloud = *out.planes.cloud;
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    const Vector3d there = cloud.origin + cloud.points[i].cast<double>();
    const Vector3d here = room.cloud->origin + room.cloud->points[i].cast<double>();
    EXPECT_NEAR((back.rotation * there + back.translation - here).norm(), 0, 1e-5);
  }
}

TEST(AlignZAxis, SaysSoIfNothingIsHorizontal) {
  Context context;
  test::Rooms walls;
  walls.walls(test::l_outline());
  for (const auto& planes : {PlanePrimitives{}, walls.planes()}) {
    try {
      ZAxis::run({input(planes), {}}, {}, context);
      FAIL();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("horizontal"), std::string::npos);
      EXPECT_NE(e.help().find("align.none"), std::string::npos);
    }
  }
  // |c| ≥ 0.6 is 53.13°.
  const auto tilted = [](double degrees) {
    test::Rooms rooms;
    const double a = degrees * std::numbers::pi / 180;
    rooms.add({0, 0, 0}, {3 * std::cos(a), 0, 3 * std::sin(a)}, {0, 3, 0}, {-std::sin(a), 0, std::cos(a)});
    return rooms.planes();
  };
  EXPECT_NO_THROW(ZAxis::run({input(tilted(53)), {}}, {}, context));
  EXPECT_THROW(ZAxis::run({input(tilted(53.3)), {}}, {}, context), Error);
}

double yaw_of(const Transform& t) { return std::atan2(t.rotation(1, 0), t.rotation(0, 0)) * 180 / std::numbers::pi; }

TEST(AlignXyPlane, UndoesAYawModulo90Degrees) {
  Context context;
  const PlanePrimitives room = test::l_room().planes();
  for (const double yaw : {-170.0, -60.0, -44.0, 0.0, 10.0, 23.0, 44.9, 45.0, 46.0, 90.0, 135.0}) {
    const auto out = XyPlane::run({input(transformed(room, pose(yaw, 0))), {}}, {}, context);
    EXPECT_GT(yaw_of(out.transform), -45.0 - 1e-9);
    EXPECT_LE(yaw_of(out.transform), 45.0 + 1e-9);
    for (const auto& primitive : out.planes->primitives)
      EXPECT_NEAR(primitive.plane.normal.cwiseAbs().maxCoeff(), 1, 1e-9) << yaw;
  }
}

TEST(AlignXyPlane, ObliqueWallsHaveNoSay) {
  Context context;
  test::Rooms rooms = test::l_room();
  rooms.wall(0, 0, 2, 0.5).wall(1, 1, 2, 2);  // 14° and 45°
  const auto out = XyPlane::run({input(transformed(rooms.planes(), pose(23, 0))), {}}, {}, context);
  EXPECT_NEAR(yaw_of(out.transform), -23, 1e-6);
}

TEST(AlignXyPlane, AreaDoesNotDependOnPointDensity) {
  Context context;
  test::Rooms rooms;
  rooms.spacing = 0.2;
  rooms.wall(0, 0, 8, 0).wall(0, 4, 0, 0);
  rooms.spacing = 0.02;
  rooms.wall(1, 1, 2, 2);  // small, but with more points than both others
  XyPlane::Params params;
  EXPECT_NEAR(yaw_of(XyPlane::run({input(rooms.planes()), {}}, params, context).transform), 0, 1e-9);
  params.weight = DirectionWeight::points;
  EXPECT_NEAR(std::abs(yaw_of(XyPlane::run({input(rooms.planes()), {}}, params, context).transform)), 45, 1e-6);
}

TEST(AlignXyPlane, LeavesARoundRoomAndARoomWithoutWallsAsTheyAre) {
  Context context;
  test::Rooms round;
  for (int k = 0; k < 36; ++k) {
    const double a = 10 * k * std::numbers::pi / 180 + 0.03;
    const double b = a + 10 * std::numbers::pi / 180;
    round.wall(3 * std::cos(a), 3 * std::sin(a), 3 * std::cos(b), 3 * std::sin(b));
  }
  test::Rooms flat;
  flat.floor(0, 0, 4, 3);
  for (const auto& planes : {input(round.planes()), input(flat.planes()), input(PlanePrimitives{})}) {
    const Transform earlier = pose(10, 5);
    const auto out = XyPlane::run({planes, input(earlier)}, {}, context);
    EXPECT_EQ(out.planes, planes);
    EXPECT_EQ(out.transform.rotation, earlier.rotation);
  }
}

}  // namespace
}  // namespace atrium::align::z_axis_test
