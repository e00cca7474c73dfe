#include "modules/floorplan/from_building.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>

#include "modules/floorplan/caption.hpp"
#include "modules/floorplan/regions.hpp"
#include "modules/types/turn_between.hpp"
#include "tests/support/box_building.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan::from_building_test {
namespace {

FloorPlan drawn(const Building& building, OptionalInput<Transform> transform = {},
                std::vector<std::string>* warnings = nullptr, const FromBuilding::Params& params = {}) {
  const auto host = std::make_shared<Host>();
  Context context(1, host);
  FloorPlan plan = FromBuilding::run({input(building), std::move(transform)}, params, context).plan;
  if (warnings != nullptr) *warnings = host->warnings;
  return plan;
}

const PlanOpening& first(const PlanStorey& storey, const std::string& kind) {
  for (const auto& opening : storey.openings)
    if (opening.kind == kind) return opening;
  throw std::runtime_error("no " + kind);
}

double length_of(const PlanStorey& storey, bool both_faces) {
  double sum = 0;
  for (const auto& wall : storey.walls)
    if ((wall.thickness > 0) == both_faces) sum += (wall.to - wall.from).norm();
  return sum;
}

TEST(FloorplanOriginHeight, IsAlongTheInputsUp) {
  FloorPlan plan;
  plan.origin = Eigen::Vector3d(500000, -5, 312);
  EXPECT_EQ(origin_height(plan), 312);
  // A little tilt far from the origin does not move it; where y points up, y is the height.
  plan.to_plan.rotation = Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_EQ(origin_height(plan), 312);
  plan.to_plan.rotation = turn_between(Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(origin_height(plan), -5, 1e-9);
}

TEST(FromBuilding, RoomsAreThoseOfTheBuilding) {
  const FloorPlan plan = drawn(test::BoxBuilding::two_rooms());
  ASSERT_EQ(plan.storeys.size(), 1U);
  const PlanStorey& storey = plan.storeys[0];
  ASSERT_EQ(storey.rooms.size(), 2U);
  EXPECT_EQ(storey.rooms[0].name, "room 1");
  EXPECT_NEAR(storey.rooms[0].polygon.area(), 12, 1e-5);
  EXPECT_NEAR(storey.rooms[1].polygon.area(), 8.64, 1e-5);
  EXPECT_NEAR(storey.rooms[0].height, 2.5, 1e-12);
  EXPECT_NEAR(storey.height, 2.5, 1e-12);
  EXPECT_NEAR(plan.origin.z() + storey.elevation, 0, 1e-12);
  EXPECT_NEAR(total_area(storey.floors), 20.64, 1e-4);
  EXPECT_NEAR(total_area(storey.ceilings), 20.64, 1e-4);
}

TEST(FromBuilding, WallsOfWhichNothingWasSeenAreInferredAndNoBodies) {
  Building building = test::BoxBuilding::two_rooms();
  building.openings.clear();
  building.rooms[0].confidence = 0.4;
  building.faces[2].primitive = -1;   // the first room's wall y = 0
  building.faces[3].observed = 0.05;  // both faces of the wall between the rooms
  building.faces[11].observed = 0.05;
  const PlanStorey storey = drawn(building).storeys.at(0);
  EXPECT_TRUE(storey.bodies.empty());
  double inferred = 0;
  for (const auto& wall : storey.walls)
    if (wall.inferred) inferred += (wall.to - wall.from).norm();
  EXPECT_NEAR(inferred, 4 + 3, 0.3);
  EXPECT_EQ(storey.rooms[0].confidence, 0.4);
  EXPECT_EQ(storey.rooms[1].confidence, -1);
  // One face that was seen is enough for a wall.
  building.faces[11].observed = 0.9;
  EXPECT_FALSE(drawn(building).storeys.at(0).bodies.empty());
}

TEST(FromBuilding, AWallWhoseThicknessWasGivenIsABodyAndIsMarked) {
  Building building = test::BoxBuilding::two_rooms();
  building.faces[2].backing = 0.36;  // the first room's wall y = 0, with the window
  building.faces[2].corrections = {"wall behind it set to 0.360 m"};
  building.openings[1].thickness = 0.36;
  building.openings[1].corrections = {"changed"};
  building.faces[7].corrections = {"raised by 0.100 m"};
  const PlanStorey storey = drawn(building).storeys.at(0);
  EXPECT_GT(total_area(storey.bodies), 0.12 * (3 - 0.9) + 0.36 * (4 - 1.5) - 1e-4);
  EXPECT_EQ(std::count_if(storey.walls.begin(), storey.walls.end(), [](const PlanWall& w) { return w.corrected; }), 2)
      << "on both sides of the window";
  for (const auto& wall : storey.walls) EXPECT_EQ(wall.corrected, std::abs(wall.thickness - 0.36) < 1e-9);
  EXPECT_FALSE(first(storey, "door").corrected);
  EXPECT_TRUE(first(storey, "window").corrected);
  EXPECT_NEAR((PlanPolygon{first(storey, "window").outline, {}}.area()), 1.5 * 0.36, 1e-9);
  EXPECT_FALSE(storey.rooms[0].corrected) << "its wall has the mark";
  EXPECT_TRUE(storey.rooms[1].corrected);
}

TEST(FromBuilding, WhereAWallMeetsAnotherAGivenThicknessMakesNoSliver) {
  // Behind the wall y = 0 of a long room are two rooms, and between these 12 cm of a wall that meets it.
  test::BoxBuilding b;
  b.room(0, 0, 8, 3);
  b.room(0, -3, 3.9, -0.12);
  b.room(4.02, -3, 8, -0.12);
  const PlanStorey before = drawn(b.building).storeys.at(0);
  b.building.faces[2].backing = 0.36;
  const PlanStorey storey = drawn(b.building).storeys.at(0);
  EXPECT_EQ(storey.walls.size(), before.walls.size());
  for (const auto& wall : storey.walls) EXPECT_LT(wall.thickness, 0.2) << "from " << wall.from.transpose();
  EXPECT_NEAR(total_area(storey.bodies), total_area(before.bodies), 1e-4);
  // Shorter than any wall is what a room behind leaves of its end.
  test::BoxBuilding end;
  end.room(0, 0, 8, 3);
  end.room(0, -3, 7.995, -0.12);
  end.building.faces[2].backing = 0.36;
  for (const auto& wall : drawn(end.building).storeys.at(0).walls) EXPECT_LT(wall.thickness, 0.2);
}

TEST(FromBuilding, OpeningsInterruptTheWalls) {
  const FloorPlan plan = drawn(test::BoxBuilding::two_rooms());
  const PlanStorey& storey = plan.storeys[0];
  // The wall of 12 cm without its door; the faces of the others without the window.
  EXPECT_NEAR(total_area(storey.bodies), 0.12 * (3 - 0.9), 1e-4);
  EXPECT_NEAR(length_of(storey, true), 3 - 0.9, 1e-6);
  EXPECT_NEAR(length_of(storey, false), 4 + 4 + 3 + 2 * 2.88 + 3 - 1.5, 1e-6);
  ASSERT_EQ(storey.openings.size(), 2U);
  const PlanOpening& door = first(storey, "door");
  EXPECT_NEAR(door.width(), 0.9, 1e-9);
  EXPECT_NEAR(door.height, 2.1, 1e-9);
  EXPECT_NEAR(door.sill, 0, 1e-9);
  EXPECT_NEAR((PlanPolygon{door.outline, {}}.area()), 0.9 * 0.12, 1e-9) << "counter-clockwise";
  EXPECT_NEAR(door.from.x() + plan.origin.x(), 4.06, 1e-9) << "on the middle line";
  EXPECT_EQ(door.room_a, 0);
  EXPECT_EQ(door.room_b, 1);
  // Room a lies on the left.
  const Eigen::Vector2d along = (door.to - door.from).normalized();
  EXPECT_NEAR(-along.y(), -1, 1e-9);
  const PlanOpening& window = first(storey, "window");
  EXPECT_NEAR(window.width(), 1.5, 1e-9);
  EXPECT_NEAR(window.sill, 0.9, 1e-9);
  EXPECT_NEAR(window.height, 1.2, 1e-9);
  EXPECT_TRUE(window.outline.empty());
  EXPECT_EQ(window.room_b, -1);
}

TEST(FromBuilding, StandsInTheInputsFrame) {
  Transform transform;  // from a scan that is turned and far away
  transform.rotation = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  transform.translation = -(transform.rotation * Eigen::Vector3d(503217.25, 5412345.5, 312.125));
  const FloorPlan plan = drawn(test::BoxBuilding::two_rooms(), input(transform));
  EXPECT_TRUE(plan.to_plan.rotation.isApprox(Eigen::Matrix3d::Identity(), 1e-12));
  EXPECT_NEAR(plan.storeys[0].rooms[0].polygon.area(), 12, 1e-5);
  EXPECT_NEAR(plan.origin.z() + plan.storeys[0].elevation, 312.125, 1e-6);
  const PlanOpening& door = first(plan.storeys[0], "door");
  const Eigen::Vector3d middle = 0.5 * (plan.origin + Eigen::Vector3d(door.from.x(), door.from.y(), 0) + plan.origin +
                                        Eigen::Vector3d(door.to.x(), door.to.y(), 0));
  const Eigen::Vector3d back = transform.rotation * middle + transform.translation;
  EXPECT_NEAR(back.x(), 4.06, 1e-6);
  EXPECT_NEAR(back.y(), 0.95, 1e-6);
}

TEST(FromBuilding, AScanThatLiesOnItsSideIsTurnedUpright) {
  Transform transform;
  transform.rotation = Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const FloorPlan plan = drawn(test::BoxBuilding::two_rooms(), input(transform));
  const Eigen::Vector3d up = plan.to_plan.rotation * transform.rotation.transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(up.isApprox(Eigen::Vector3d::UnitZ(), 1e-9));
  EXPECT_NEAR(plan.storeys[0].rooms[0].polygon.area(), 12, 1e-5);
  // The turn is about the plan's origin.
  const Eigen::Vector3d moved = plan.to_plan.rotation * plan.origin + plan.to_plan.translation;
  EXPECT_LT((moved - plan.origin).norm(), 1e-9);
}

TEST(FromBuilding, JunctionsOfWallsAreFilled) {
  // Three rooms around a T of walls of 12 cm.
  test::BoxBuilding b;
  b.room(0, 0, 3, 3);
  b.room(3.12, 0, 6, 3);
  b.room(0, 3.12, 6, 6);
  const PlanStorey storey = drawn(b.building).storeys[0];
  ASSERT_EQ(storey.bodies.size(), 1U) << "one body of wall";
  EXPECT_NEAR(total_area(storey.bodies), 6 * 0.12 + 3 * 0.12, 1e-3);
  for (const auto& wall : storey.walls) EXPECT_GT((wall.to - wall.from).norm(), 1) << "no face where another wall ends";
}

TEST(FromBuilding, HolesInSlabsAreDrawnInBothStoreys) {
  test::BoxBuilding b;
  b.building.storeys = {{0, 2.5}, {2.8, 2.5}};
  b.room(0, 0, 6, 4, 0, 2.5, 0);
  b.room(0, 0, 6, 4, 2.8, 5.3, 1);
  BuildingOpening hole{"slab", 1, 0, 6, 1, 0.3, {}, {}};
  hole.outline_a = {{1, 1, 2.8}, {3, 1, 2.8}, {3, 2, 2.8}, {1, 2, 2.8}};
  hole.outline_b = {{1, 1, 2.5}, {1, 2, 2.5}, {3, 2, 2.5}, {3, 1, 2.5}};
  b.building.openings.push_back(hole);
  const FloorPlan plan = drawn(b.building);
  ASSERT_EQ(plan.storeys.size(), 2U);
  const PlanOpening &overhead = first(plan.storeys[0], "slab"), &in_floor = first(plan.storeys[1], "slab");
  EXPECT_NEAR(overhead.sill, 2.5, 1e-9);
  EXPECT_NEAR(in_floor.sill, 0, 1e-9);
  EXPECT_NEAR((PlanPolygon{overhead.outline, {}}.area()), 2, 1e-9);
  EXPECT_NEAR(total_area(plan.storeys[0].floors), 24, 1e-4);
  EXPECT_NEAR(total_area(plan.storeys[0].ceilings), 22, 1e-4);
  EXPECT_NEAR(total_area(plan.storeys[1].floors), 22, 1e-4);
}

TEST(FromBuilding, StepsWithinARoomAreNoWalls) {
  test::BoxBuilding b;
  b.room(0, 0, 6, 4);
  const auto v = static_cast<std::uint32_t>(b.building.vertices.size());
  for (const auto& p : std::vector<Eigen::Vector3d>{{3, 0, 0}, {3, 0, 2.5}, {3, 4, 2.5}, {3, 4, 0}})
    b.building.vertices.push_back(p);
  BuildingFace step;
  step.room = 0;
  step.plane = {-Eigen::Vector3d::UnitX(), 3};
  step.outline = {v, v + 1, v + 2, v + 3};
  b.building.faces.push_back(step);
  BuildingOpening hatch{"window", 0, -1, 6, -1, 0, {}, {}};
  hatch.outline_a = {{3, 1, 1}, {3, 1, 2}, {3, 2, 2}, {3, 2, 1}};
  b.building.openings.push_back(hatch);
  const PlanStorey storey = drawn(b.building).storeys[0];
  EXPECT_EQ(storey.walls.size(), 4U);
  EXPECT_TRUE(storey.openings.empty());
}

TEST(FromBuilding, WallsThatEndBelowTheSectionAreDrawn) {
  test::BoxBuilding b;
  b.room(0, 0, 6, 4);
  // The wall y = 4 is 0.8 m high, but under a dormer from x = 2 to 3 it reaches 2 m; the wall y = 0 is a lintel from x
  // = 1 to 3.
  auto& v = b.building.vertices;
  const auto add = [&](double x, double y, double z) {
    v.emplace_back(x, y, z);
    return static_cast<std::uint32_t>(v.size()) - 1;
  };
  for (const std::size_t corner : {6U, 7U}) v[corner].z() = 0.8;
  b.building.faces[4].outline = {2, 6, add(3, 4, 0.8), add(3, 4, 2), add(2, 4, 2), add(2, 4, 0.8), 7, 3};
  b.building.faces[2].outline = {0, 4, 5, 1, add(3, 0, 0), add(3, 0, 2.1), add(1, 0, 2.1), add(1, 0, 0)};
  std::map<double, double> lengths;
  const FloorPlan plan = drawn(b.building);
  for (const auto& wall : plan.storeys[0].walls)
    if (std::abs(wall.to.y() - wall.from.y()) < 1e-6)
      lengths[wall.from.y() + plan.origin.y()] += (wall.to - wall.from).norm();
  EXPECT_NEAR(lengths[4], 6, 1e-6);
  EXPECT_NEAR(lengths[0], 4, 1e-6);
}

TEST(FromBuilding, ABuildingWithoutRoomsIsAnEmptyPlan) {
  std::vector<std::string> warnings;
  EXPECT_TRUE(drawn(Building{}, {}, &warnings).storeys.empty());
  EXPECT_EQ(warnings.size(), 1U);
  Building building = test::BoxBuilding::two_rooms();
  building.rooms[1].outline.clear();
  EXPECT_EQ(drawn(building, {}, &warnings).storeys[0].rooms.size(), 1U);
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(FromBuilding, BrokenBuildingsAreErrors) {
  const auto error = [](const std::function<void(Building&)>& damage) -> std::string {
    Building building = test::BoxBuilding::two_rooms();
    damage(building);
    try {
      drawn(building);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error([](auto&) {}), "no error");
  EXPECT_EQ(error([](auto& b) { b.vertices[2].y() = NAN; }),
            "vertex 2 of the building has a number that is not finite");
  EXPECT_EQ(error([](auto& b) { b.faces[4].storey = 1; }), "face 4 of the building names storey 1 of 1");
  EXPECT_EQ(error([](auto& b) { b.faces[4].outline[2] = 16; }), "face 4 of the building names vertex 16 of 16");
  EXPECT_EQ(error([](auto& b) { b.rooms[1].storey = -1; }), "room 1 of the building names storey -1 of 1");
  FromBuilding::Params params;
  params.min_thickness = 1;
  EXPECT_THROW(drawn(test::BoxBuilding::two_rooms(), {}, nullptr, params), Error);
}

}  // namespace
}  // namespace atrium::floorplan::from_building_test
