#include "modules/align/gravity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "modules/types/turn_between.hpp"
#include "tests/support/rooms.hpp"
#include "tests/support/warnings.hpp"

namespace atrium::align::gravity_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double radians = std::numbers::pi / 180;

Transform turn(const Vector3d& axis, double degrees) {
  return {AngleAxisd(degrees * radians, axis.normalized()).toRotationMatrix(), {3, -2, 7}};
}
/// A scene with z up in a frame in which `up` is.
Transform frame_with(const Vector3d& up) {
  Transform t;
  t.rotation = up.z() < -0.99 ? AngleAxisd(std::numbers::pi, Vector3d::UnitX()).toRotationMatrix()
                              : turn_between(Vector3d::UnitZ(), up).toRotationMatrix();
  return t;
}

/// A closed box that stands on the floor, 4 cm above it as scans leave it.
void box(test::Rooms& rooms, double x, double y, double wide, double deep, double height) {
  rooms.floor(x, y, x + wide, y + deep, height);
  rooms.wall(x + wide, y, x, y, 0.04, height).wall(x + wide, y + deep, x + wide, y, 0.04, height);
  rooms.wall(x, y + deep, x + wide, y + deep, 0.04, height).wall(x, y, x, y + deep, 0.04, height);
}

/// A cube, whose sides say nothing: 3 × 3 × 3 m, with a table, two seats and a door of 0.9 × 2.05 m.
test::Rooms furnished_cube() {
  test::Rooms rooms;
  rooms.floor(0, 0, 3, 3).ceiling(0, 0, 3, 3, 3).walls({{0, 0}, {3, 0}, {3, 3}}, 0, 0, 3);
  rooms.wall(0, 3, 0, 0, 0, 3);
  rooms.add({0, 3, 0}, {3, 0, 0}, {0, 0, 3}, {0, -1, 0},
            [](const Vector3d& p) { return !(p.x() > 1 && p.x() < 1.9 && p.z() < 2.05); });
  box(rooms, 0.8, 0.9, 1.4, 0.8, 0.74);
  box(rooms, 0.9, 0.3, 0.42, 0.42, 0.45);
  box(rooms, 1.6, 0.3, 0.42, 0.42, 0.45);
  return rooms;
}

/// As region growing gives them: on which side a plane was seen is not known.
PlanePrimitives without_sides(PlanePrimitives planes) {
  for (std::size_t i = 0; i < planes.primitives.size(); i += 2) {
    Plane& plane = planes.primitives[i].plane;
    plane = {-plane.normal, -plane.offset};
  }
  return planes;
}

double degrees_off(const Gravity::Out& out, const Transform& frame) {
  const Vector3d up = out.transform.rotation * frame.rotation * Vector3d::UnitZ();
  return std::atan2(up.cross(Vector3d::UnitZ()).norm(), up.z()) / radians;
}

TEST(AlignGravity, FindsTheFloorOfAFurnishedCubeInAnyFrame) {
  const PlanePrimitives cube = without_sides(furnished_cube().planes());
  for (const Vector3d& up : {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(0, 1, 0), Vector3d(0, -1, 0),
                             Vector3d(1, 0, 0), Vector3d(-1, 0, 0)}) {
    test::Warnings warnings;
    const Transform frame = chained(frame_with(up), turn({1, 2, 0.5}, 3));
    const auto out = Gravity::run({input(transformed(cube, frame)), {}}, {}, warnings.context());
    // Hardly a file has its up there: two seats and a table may not outweigh that, but it is said.
    if (degrees_off(out, frame) > 1e-3) {
      EXPECT_FALSE(up.z() > 0 || up.y() > 0) << up.transpose();
      EXPECT_LT(out.transform.upright, 0.9) << up.transpose();
      ASSERT_EQ(warnings.texts().size(), 1U);
      EXPECT_NE(warnings.texts()[0].find("but it may be"), std::string::npos) << warnings.texts()[0];
      continue;
    }
    EXPECT_NEAR(out.transform.rotation.determinant(), 1, 1e-12);
    EXPECT_EQ(warnings.texts().empty(), up.z() > 0) << up.transpose();
    if (up.z() > 0) continue;
    const auto setting = fmt::format("-s upright.up=[{},{},{}]", up.x() + 0.0, up.y() + 0.0, up.z() + 0.0);
    ASSERT_EQ(warnings.texts().size(), 1U);
    EXPECT_NE(warnings.texts()[0].find(setting), std::string::npos) << warnings.texts()[0];
  }
}

TEST(AlignGravity, BelievesZWhereNothingTells) {
  test::Rooms cube;
  cube.floor(0, 0, 3, 3).ceiling(0, 0, 3, 3, 3).walls({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, 0, 0, 3);
  test::Warnings warnings;
  const auto out = Gravity::run({input(without_sides(cube.planes())), {}}, {}, warnings.context());
  EXPECT_LT(degrees_off(out, {}), 1e-6);
  // The format's habit is enough where nothing else tells.
  const auto habit =
      Gravity::run({input(without_sides(cube.planes())), {}}, {.habit = Gravity::Habit::y}, warnings.context());
  EXPECT_NEAR((habit.transform.rotation * Vector3d::UnitY() - Vector3d::UnitZ()).norm(), 0, 1e-6);
  EXPECT_NEAR(habit.transform.upright, 0.6, 0.1);
  EXPECT_NEAR(out.transform.upright, 0.9, 0.05);
  // Unless it is set, the cloud knows it.
  PlanePrimitives planes = without_sides(cube.planes());
  Cloud cloud = *planes.cloud;
  cloud.y_up = true;
  planes.cloud = std::make_shared<const Cloud>(cloud);
  const auto known = Gravity::run({input(planes), {}}, {}, warnings.context());
  EXPECT_EQ(known.transform.rotation, habit.transform.rotation);
  EXPECT_FALSE(known.planes.cloud->y_up);  // it is turned
}

TEST(AlignGravity, TakesOutATiltAndWarnsOfALargeOne) {
  const PlanePrimitives room = without_sides(test::box_room().planes());
  for (const double tilt : {0.0, 0.7, 4.0, 6.0, 12.0}) {
    test::Warnings warnings;
    const Transform frame = turn({1, 2, 0}, tilt);
    const auto out = Gravity::run({input(transformed(room, frame)), {}}, {}, warnings.context());
    EXPECT_LT(degrees_off(out, frame), 1e-3) << tilt;
    EXPECT_EQ(warnings.texts().size(), tilt > 5 ? 1U : 0U) << tilt;
  }
}

/// Slopes of 45 degrees with more area than the floor.
test::Rooms attic() {
  test::Rooms rooms;
  rooms.floor(0, 0, 8, 7).ceiling(0, 2.2, 8, 4.8, 3.2).wall(0, 0, 8, 0, 0, 1).wall(8, 7, 0, 7, 0, 1);
  rooms.add({0, 0, 1}, {8, 0, 0}, {0, 2.2, 2.2}, {0, 1, -1}).add({0, 7, 1}, {8, 0, 0}, {0, -2.2, 2.2}, {0, -1, -1});
  const auto under = [](const Vector3d& p) { return p.z() < std::min(3.2, 1 + std::min(p.y(), 7 - p.y())); };
  rooms.add({8, 0, 0}, {0, 7, 0}, {0, 0, 3.2}, {-1, 0, 0}, under)
      .add({0, 0, 0}, {0, 7, 0}, {0, 0, 3.2}, {1, 0, 0}, under);
  return rooms;
}

TEST(AlignGravity, SlopesDoNotTiltAnAttic) {
  for (const double tilt : {0.0, 2.5}) {
    test::Warnings warnings;
    const Transform frame = turn({1, -1, 0}, tilt);
    const auto out =
        Gravity::run({input(transformed(without_sides(attic().planes()), frame)), {}}, {}, warnings.context());
    EXPECT_LT(degrees_off(out, frame), 1e-3);
    EXPECT_TRUE(warnings.texts().empty());
  }
}

TEST(AlignGravity, SlopesAreAbove) {
  for (const double z : {1.0, -1.0}) {
    test::Warnings warnings;
    const Transform frame = frame_with({0, 0, z});
    const auto out = Gravity::run({input(transformed(without_sides(attic().planes()), frame)), {}}, {.prior = 0},
                                  warnings.context());
    EXPECT_LT(degrees_off(out, frame), 1e-3) << z;
  }
}

/// 3.4 × 2.7 × 2.5 m with a beam along its longer side, 0.45 m deep.
test::Rooms room_with_a_beam() {
  test::Rooms rooms;
  rooms.floor(0, 0, 3.4, 2.7).ceiling(0, 0, 3.4, 2.2).walls({{0, 0}, {3.4, 0}, {3.4, 2.7}, {0, 2.7}});
  rooms.ceiling(0, 2.2, 3.4, 2.7, 2.05).wall(3.4, 2.2, 0, 2.2, 2.05, 2.5);
  return rooms;
}

/// The same with a bed and a heap of clothes, which are on no plane, and a stool.
test::Rooms bedroom() {
  test::Rooms rooms = room_with_a_beam();
  for (double x = 0.1; x < 2.0; x += 0.04)
    for (double y = 0.1; y < 1.0; y += 0.04) rooms.stray({x, y, 0.45 + 0.08 * std::sin(9 * x) * std::cos(11 * y)});
  for (double x = 0.1; x < 2.0; x += 0.04)
    for (double z = 0.05; z < 0.4; z += 0.04) rooms.stray({x, 1.0 + 0.06 * std::sin(13 * x + 9 * z), z});
  for (double a = 0; a < 6; a += 0.05)
    for (double z = 0.05; z < 0.9; z += 0.04)
      rooms.stray({2.8 + 0.3 * std::sin(3 * z) * std::cos(a), 2.1 + 0.3 * std::sin(3 * z) * std::sin(a), z});
  box(rooms, 2.5, 0.3, 0.42, 0.42, 0.45);
  return rooms;
}

TEST(AlignGravity, ABeamIsNoTable) {
  test::Warnings warnings;
  const auto out =
      Gravity::run({input(without_sides(room_with_a_beam().planes())), {}}, {.prior = 0}, warnings.context());
  EXPECT_LT(out.transform.upright, degrees_off(out, {}) > 1 ? 0.4 : 0.9) << "nothing but its height tells";
}

TEST(AlignGravity, WhatIsOnNoPlaneLiesLow) {
  const PlanePrimitives room = without_sides(bedroom().planes());
  for (const Vector3d& up : {Vector3d(0, 0, 1), Vector3d(0, 1, 0)}) {
    test::Warnings warnings;
    const Transform frame = frame_with(up);
    const auto out = Gravity::run({input(transformed(room, frame)), {}}, {}, warnings.context());
    EXPECT_LT(degrees_off(out, frame), 1e-2) << up.transpose();
    EXPECT_GT(out.transform.upright, up.z() > 0 ? 0.9 : 0.5) << up.transpose();
  }
}

TEST(AlignGravity, WallsAloneGiveTheTilt) {
  test::Rooms rooms;
  rooms.walls(test::l_outline());
  test::Warnings warnings;
  const Transform frame = turn({1, 2, 0}, 3);
  const auto out = Gravity::run({input(transformed(rooms.planes(), frame)), {}}, {}, warnings.context());
  EXPECT_LT(degrees_off(out, frame), 1e-3);
}

TEST(AlignGravity, UpForcesTheAxisButNotTheTilt) {
  const PlanePrimitives cube = furnished_cube().planes();
  Context context;
  const Transform frame = turn({1, 2, 0}, 3);
  const auto out = Gravity::run({input(transformed(cube, frame)), {}}, {.up = {0, -2, 0}}, context);
  const Vector3d down = out.transform.rotation * frame.rotation * Vector3d::UnitY();
  EXPECT_NEAR(down.z(), -1, 1e-6);
  EXPECT_THROW(Gravity::run({input(cube), {}}, {.up = {0, 1}}, context), Error);
  EXPECT_THROW(Gravity::run({input(cube), {}}, {.up = {0, std::nan(""), 1}}, context), Error);
}

TEST(AlignGravity, TransformLeadsFromTheInputFrameOverEarlierSteps) {
  Context context;
  const PlanePrimitives room = test::box_room().origin({500000, 5400000, 300}).planes();
  const Transform earlier = turn({2, 1, 1}, 5);
  const auto out = Gravity::run({input(transformed(room, earlier)), input(earlier)}, {}, context);
  const Transform back = inverse(out.transform);
  const auto& cloud = *out.planes.cloud;
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    const Vector3d there = cloud.origin + cloud.points[i].cast<double>();
    const Vector3d here = room.cloud->origin + room.cloud->points[i].cast<double>();
    EXPECT_NEAR((back.rotation * there + back.translation - here).norm(), 0, 1e-5);
  }
}

TEST(AlignGravity, NoPlaneIsAnError) {
  Context context;
  EXPECT_THROW(Gravity::run({input(PlanePrimitives{}), {}}, {}, context), Error);
}

}  // namespace
}  // namespace atrium::align::gravity_test
