#include "modules/segment/structure.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/rooms.hpp"

namespace atrium::segment::structure_test {
namespace {

using Eigen::Vector3d;

Structure::Out segmented(const PlanePrimitives& planes, Structure::Params params = {}) {
  Context context;
  return Structure::run({input(planes)}, params, context);
}

double report(const Structure::Out& out, const std::string& name) {
  for (const auto& metric : out.report.values)
    if (metric.name == "structure." + name) return metric.value;
  ADD_FAILURE() << "no metric " << name;
  return -1;
}

std::string error_of(const PlanePrimitives& planes, Structure::Params params = {}) {
  try {
    segmented(planes, params);
  } catch (const Error& e) {
    EXPECT_FALSE(e.help().empty());
    return e.what();
  }
  return "";
}

TEST(SegmentStructure, FindsTheSurfacesOfABoxRoom) {
  test::Rooms rooms = test::box_room();
  rooms.floor(1, 1, 2, 2, 0.75).stray({2, 2, 1}).stray({2, 2, 1.2});  // a table and two points of nothing
  const auto out = segmented(rooms.unsorted());
  EXPECT_EQ(out.structure.classes,
            (std::vector{SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::wall, SurfaceClass::wall,
                         SurfaceClass::wall, SurfaceClass::wall, SurfaceClass::object}));
  EXPECT_EQ(out.structure.storeys, (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0, -1}));
  EXPECT_EQ(report(out, "planes"), 7);
  EXPECT_EQ(report(out, "walls"), 4);
  EXPECT_EQ(report(out, "floors"), 1);
  EXPECT_EQ(report(out, "ceilings"), 1);
  EXPECT_EQ(report(out, "storeys"), 1);
  EXPECT_EQ(report(out, "object_points"), 21 * 21 + 2);
  EXPECT_EQ(out.objects.size(), 21U * 21U + 2U);
  EXPECT_EQ(out.objects.normals.size(), out.objects.points.size());
}

TEST(SegmentStructure, DoesNotDependOnWhereZeroIs) {
  const PlanePrimitives room = test::box_room().floor(1, 1, 2, 2, 0.75).ceiling(0, 0, 1, 3, 2.1).unsorted();
  const auto expected = segmented(room).structure.classes;
  EXPECT_EQ(expected[7], SurfaceClass::ceiling);  // 2.1 of 2.5 m
  for (const double z : {-100.0, -2.5, -1.25, 1.0, 50.0}) {
    PlanePrimitives moved = room;
    Cloud cloud = *room.cloud;
    for (auto& p : cloud.points) p.z() += static_cast<float>(z);
    for (auto& p : moved.primitives) p.plane.offset -= p.plane.normal.z() * z;
    moved.cloud = std::make_shared<const Cloud>(cloud);
    EXPECT_EQ(segmented(moved).structure.classes, expected) << z;
  }
}

TEST(SegmentStructure, SharesOfHeightDecideOverSeveralFloorsAndCeilings) {
  test::Rooms rooms = test::box_room();
  rooms.ceiling(0, 0, 1, 3, 1.80).ceiling(1, 0, 2, 3, 1.70);  // 0.7 · 2.5 = 1.75
  rooms.floor(2, 0, 3, 3, 0.20).floor(3, 0, 4, 3, 0.30);      // 0.9 · 2.5 = 2.25 under the ceiling
  const auto classes = segmented(rooms.unsorted()).structure.classes;
  EXPECT_EQ(classes[6], SurfaceClass::ceiling);
  EXPECT_EQ(classes[7], SurfaceClass::object);
  EXPECT_EQ(classes[8], SurfaceClass::floor);
  EXPECT_EQ(classes[9], SurfaceClass::object);
}

TEST(SegmentStructure, WallsAreSteepAndHigh) {
  test::Rooms rooms = test::box_room();
  rooms.wall(1, 1, 2, 1, 0, 1.45).wall(1, 1, 2, 1, 0.5, 2.05);
  const auto tilted = [&](double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    rooms.add({1, 1, 0}, {1, 0, 0}, {0, 2 * std::cos(a), 2 * std::sin(a)}, {0, -std::sin(a), std::cos(a)});
  };
  for (const double angle : {86.0, 84.0, 45.0, 21.0}) tilted(angle);
  const auto out = segmented(rooms.unsorted());
  EXPECT_EQ(out.structure.classes[6], SurfaceClass::object);
  EXPECT_EQ(out.structure.classes[7], SurfaceClass::wall);
  EXPECT_EQ(out.structure.classes[8], SurfaceClass::wall);
  EXPECT_EQ(out.structure.classes[9], SurfaceClass::object);
  EXPECT_EQ(report(out, "planes_between_angles"), 3);
}

/// 6 × 4 m, gable roof from 1.5 m at the eaves (y = 0, y = 4) to 4.5 m at the ridge: 56.3°.
test::Rooms attic() {
  test::Rooms rooms;
  rooms.floor(0, 0, 6, 4)
      .wall(0, 0, 6, 0, 0, 1.55)
      .wall(6, 4, 0, 4, 0, 1.55)
      .wall(6, 0, 6, 4, 0, 4)
      .wall(0, 4, 0, 0, 0, 4);
  rooms.add({0, 0, 1.5}, {6, 0, 0}, {0, 2, 3}, {0, 3, -2}).add({0, 4, 1.5}, {6, 0, 0}, {0, -2, 3}, {0, -3, -2});
  return rooms;
}

TEST(SegmentStructure, SlantedCeilingsAreLostUnlessTheLimitAllowsThem) {
  const auto lost = segmented(attic().unsorted());
  EXPECT_EQ(report(lost, "planes_between_angles"), 2);
  EXPECT_EQ(report(lost, "ceilings"), 0);
  Structure::Params params;
  params.slanted_ceiling_angle = 60;
  const auto found = segmented(attic().unsorted(), params);
  EXPECT_EQ(report(found, "planes_between_angles"), 0);
  EXPECT_EQ(report(found, "ceilings"), 2);
  EXPECT_EQ(report(found, "storeys"), 1);
}

/// Two storeys of 6 × 4 m with a slab of 30 cm; the upper floor has a hole for the stairs.
test::Rooms house() {
  test::Rooms rooms;
  rooms.floor(0, 0, 6, 4).ceiling(0, 0, 6, 4, 2.5).walls({{0, 0}, {6, 0}, {6, 4}, {0, 4}});
  rooms.floor(0, 0, 6, 4, 2.8, [](const Vector3d& p) { return p.x() > 1.5 || p.y() > 3; });
  rooms.ceiling(0, 0, 6, 4, 5.3).walls({{0, 0}, {6, 0}, {6, 4}, {0, 4}}, 0, 2.8, 5.3);
  rooms.wall(3, 0, 3, 4, 0, 5.2);  // through both, a little more in the lower one
  return rooms;
}

TEST(SegmentStructure, TellsStoreysApart) {
  test::Rooms rooms = house();
  rooms.floor(1, 1, 2, 2, 0.7).floor(1, 1, 2, 2, 3.5);  // tables: 441 of 9801 points
  const auto out = segmented(rooms.unsorted());
  EXPECT_EQ(out.structure.storey_count, 2);
  EXPECT_EQ(out.structure.storeys, (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 0, -1, -1}));
  EXPECT_EQ(out.structure.classes[6], SurfaceClass::floor);
  EXPECT_EQ(out.structure.classes[7], SurfaceClass::ceiling);
  EXPECT_EQ(out.structure.classes[1], SurfaceClass::ceiling);
}

TEST(SegmentStructure, AStoreyUnderASlantedRoofCounts) {
  test::Rooms rooms;
  rooms.floor(0, 0, 6, 4).ceiling(0, 0, 6, 4, 2.5).walls({{0, 0}, {6, 0}, {6, 4}, {0, 4}}).floor(0, 0, 6, 4, 2.8);
  rooms.wall(6, 0, 6, 4, 2.8, 5.5).wall(0, 4, 0, 0, 2.8, 5.5);
  rooms.add({0, 0, 3.8}, {6, 0, 0}, {0, 2, 3}, {0, 3, -2}).add({0, 4, 3.8}, {6, 0, 0}, {0, -2, 3}, {0, -3, -2});
  for (const double angle : {20.0, 60.0}) {
    Structure::Params params;
    params.slanted_ceiling_angle = angle;
    const auto out = segmented(rooms.unsorted(), params);
    EXPECT_EQ(out.structure.storey_count, 2) << angle;
    EXPECT_EQ(out.structure.classes[6], SurfaceClass::floor);
    EXPECT_EQ(out.structure.storeys[7], 1);
    EXPECT_EQ(report(out, "ceilings"), angle < 30 ? 1 : 3);
  }
}

TEST(SegmentStructure, AWardrobeIsNoStorey) {
  test::Rooms rooms = test::box_room();
  rooms.ceiling(0, 0, 4, 1, 2.0).floor(0, 0, 4, 1, 2.05);  // a bunk: seen from below and from above
  const auto out = segmented(rooms.unsorted());
  EXPECT_EQ(out.structure.storey_count, 1);
  EXPECT_EQ(out.structure.classes[7], SurfaceClass::object);
}

TEST(SegmentStructure, MissingFloorOrCeilingIsAWarningOnly) {
  test::Rooms floor, ceiling;
  floor.floor(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  ceiling.ceiling(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}).floor(1, 0, 3, 1, 2.2);  // and a wardrobe's top
  EXPECT_EQ(report(segmented(floor.planes()), "floors"), 1);
  const auto out = segmented(ceiling.unsorted());
  EXPECT_EQ(report(out, "ceilings"), 1);
  EXPECT_EQ(out.structure.classes[5], SurfaceClass::object);
}

TEST(SegmentStructure, SaysThatThereIsNoRoom) {
  test::Rooms floor, walls, low;
  floor.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3);
  walls.walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  low.floor(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 0, 0, 1.4);
  for (const auto& planes : {PlanePrimitives{}, floor.planes(), walls.planes(), low.planes()})
    EXPECT_EQ(error_of(planes).substr(0, 16), "no room is in it");
  Structure::Params params;
  params.horizontal_angle = 88;
  EXPECT_NE(error_of(test::box_room().planes(), params).find("wall_angle"), std::string::npos);
}

TEST(SegmentStructure, FurnitureWithoutItsRoomIsNoRoom) {
  test::Rooms rooms;
  rooms.floor(2, 2, 3.5, 3, 0.73).floor(2, 5, 2.5, 5.5, 0.45);  // a table, a chair
  rooms.floor(0.2, 0.1, 2, 0.6, 0.9);                           // a worktop at a wall
  rooms.wall(0, 0, 2, 0, 0, 2.1)
      .wall(0, 0.5, 0, 1.2, 0, 2.1)
      .wall(4.5, 2, 4.5, 4);  // cupboards, what is left of a wall
  EXPECT_NE(error_of(rooms.planes()).find("only 0 % of the walls' length"), std::string::npos);
  Structure::Params params;
  params.min_wall_contact = 0;
  EXPECT_EQ(report(segmented(rooms.planes(), params), "walls"), 3);
  rooms.floor(0, 0, 4.5, 4, 0);
  EXPECT_EQ(report(segmented(rooms.planes()), "floors"), 1);
}

TEST(SegmentStructure, ContactDistanceSaysHowNearAFloorIsToAWallsFoot) {
  test::Rooms rooms;
  rooms.floor(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 0, 0.6, 2.5);  // feet 60 cm above the floor
  EXPECT_NE(error_of(rooms.planes()).find("only 0 % of the walls' length"), std::string::npos);
  Structure::Params params;
  params.contact_distance = 0.65;
  EXPECT_EQ(report(segmented(rooms.planes(), params), "walls"), 4);
  params.contact_distance = 0.55;
  EXPECT_NE(error_of(rooms.planes(), params), "");
}

TEST(SegmentStructure, TenPercentAloneMakesALargeTableAFloor) {
  test::Rooms rooms = house();
  rooms.floor(1, 1, 3, 2, 0.75).ceiling(4, 1, 5, 2, 4.0);  // a table of 861 points, a lamp of 441 of 9801
  Structure::Params params;
  const auto both = segmented(rooms.unsorted(), params).structure.classes;
  EXPECT_EQ(both[13], SurfaceClass::object);
  params.storey_rule = StoreyRule::share;
  EXPECT_EQ(segmented(rooms.unsorted(), params).structure.classes, both);  // less than ten percent, both of them
  params.storey_share = 0.08;
  auto expected = both;
  expected[13] = SurfaceClass::floor;
  EXPECT_EQ(segmented(rooms.unsorted(), params).structure.classes, expected);
  params.storey_rule = StoreyRule::both;
  EXPECT_EQ(segmented(rooms.unsorted(), params).structure.classes, both);
  // One storey: equation 1 decides whatever the rule is.
  test::Rooms room = test::box_room();
  room.floor(1, 1, 3, 2, 0.75);
  params.storey_rule = StoreyRule::share;
  EXPECT_EQ(segmented(room.unsorted(), params).structure.classes[6], SurfaceClass::object);
}

TEST(SegmentStructure, ASlopesTopReachesTheMainCeilingItsMeanDoesNot) {
  test::Rooms rooms = test::box_room();
  rooms.add({0, 0, 0.8}, {0, 3, 0}, {1, 0, 1.7}, {1.7, 0, -1});  // from 0.8 to 2.5 m, on average 1.65: 0.66 of 2.5 m
  Structure::Params params;
  params.slanted_ceiling_angle = 65;
  EXPECT_EQ(segmented(rooms.unsorted(), params).structure.classes[6], SurfaceClass::ceiling);
  params.ceiling_height = CeilingHeight::mean;
  EXPECT_EQ(segmented(rooms.unsorted(), params).structure.classes[6], SurfaceClass::object);
  params.ceiling_share = 0.65;
  EXPECT_EQ(segmented(rooms.unsorted(), params).structure.classes[6], SurfaceClass::ceiling);
}

TEST(SegmentStructure, PositionStandsInForNormals) {
  PlanePrimitives planes = test::box_room().unsorted();
  for (auto& p : planes.primitives) p.plane = {-p.plane.normal, -p.plane.offset};
  Structure::Params params;
  params.sides = Sides::position;
  const auto out = segmented(planes, params);
  EXPECT_EQ(out.structure.classes[0], SurfaceClass::floor);
  EXPECT_EQ(out.structure.classes[1], SurfaceClass::ceiling);
}

TEST(SegmentStructure, PrimitivesWithoutPointsAreObjects) {
  PlanePrimitives planes = test::box_room().unsorted();
  planes.primitives.push_back({});
  const auto out = segmented(planes);
  EXPECT_EQ(out.structure.classes.back(), SurfaceClass::object);
  EXPECT_EQ(report(out, "walls"), 4);
}

}  // namespace
}  // namespace atrium::segment::structure_test
