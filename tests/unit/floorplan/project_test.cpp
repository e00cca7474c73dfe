#include "modules/floorplan/project.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan::project_test {
namespace {

std::vector<PlanWall> thick(const PlanStorey& storey) {
  std::vector<PlanWall> walls;
  for (const auto& wall : storey.walls)
    if (wall.thickness > 0) walls.push_back(wall);
  return walls;
}

double single_length(const PlanStorey& storey) {
  double sum = 0;
  for (const auto& wall : storey.walls)
    if (wall.thickness <= 0) sum += (wall.to - wall.from).norm();
  return sum;
}

std::string error_of(const Mesh& mesh, const Project::Params& params = {}) {
  try {
    plan_of(mesh, params);
  } catch (const Error& error) {
    EXPECT_FALSE(error.help().empty());
    return error.what();
  }
  return "no error";
}

// The room's corners are these, each within a micrometre, in the frame of the mesh.
void expect_corners(const FloorPlan& plan, const PlanRoom& room, const PlanRing& corners) {
  EXPECT_EQ(room.polygon.outline.size(), corners.size());
  EXPECT_TRUE(room.polygon.holes.empty());
  for (const auto& corner : corners) {
    double nearest = 1e9;
    for (const auto& p : room.polygon.outline)
      nearest = std::min(nearest, (plan.origin.head<2>() + p - corner).cwiseAbs().maxCoeff());
    EXPECT_LT(nearest, 1e-6) << corner.transpose();
  }
}

TEST(Project, TwoRoomsHaveOneWallOfKnownThicknessBetweenThem) {
  std::vector<std::string> warnings;
  const FloorPlan plan = plan_of(two_rooms(), {}, &warnings);
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(plan.storeys.size(), 1U);
  const PlanStorey& storey = plan.storeys[0];
  EXPECT_NEAR(plan.origin.z() + storey.elevation, 0, 1e-12);
  EXPECT_NEAR(storey.height, 2.5, 1e-12);
  ASSERT_EQ(thick(storey).size(), 1U);
  EXPECT_NEAR(thick(storey)[0].thickness, 0.12, 1e-9);
  EXPECT_EQ(thick(storey)[0].primitives.size(), 2U);
  EXPECT_NEAR(PlanPolygon({thick(storey)[0].outline, {}}).area(), 0.12 * 3, 1e-6);
  EXPECT_NEAR(total_area(storey.bodies), 0.12 * 3, 1e-6);
  EXPECT_NEAR(single_length(storey), 2 * 4 + 3 + 2 * 2.88 + 3, 1e-6);
  ASSERT_EQ(storey.rooms.size(), 2U);
  EXPECT_EQ(storey.rooms[0].name, "Room 1");
  expect_corners(plan, storey.rooms[0], {{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  expect_corners(plan, storey.rooms[1], {{4.12, 0}, {7, 0}, {7, 3}, {4.12, 3}});
  EXPECT_NEAR(storey.rooms[0].height, 2.5, 1e-9);
  EXPECT_NEAR(total_area(storey.floors), 20.64, 1e-6);
  EXPECT_NEAR(total_area(storey.ceilings), 20.64, 1e-6);
}

TEST(Project, RoomsReachToFacesAtReflexCornersAndObliqueWallsToo) {
  MeshBuilder ell;  // 0.123456 m off whole metres, so that no grid helps
  const double o = 0.123456;
  const PlanRing corners{{o, o}, {o + 6, o}, {o + 6, o + 2}, {o + 3, o + 2}, {o + 3, o + 5}, {o, o + 5}};
  ell.floor(o, o, o + 6, o + 2);
  ell.floor(o, o + 2, o + 3, o + 5);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    ell.wall(a.x(), a.y(), b.x(), b.y());
  }
  const FloorPlan plan = plan_of(ell.mesh);
  ASSERT_EQ(plan.storeys.at(0).rooms.size(), 1U);
  expect_corners(plan, plan.storeys[0].rooms[0], corners);

  Mesh turned = ell.mesh;
  const Eigen::Rotation2Dd turn(0.4);
  for (auto& v : turned.vertices) v.head<2>() = turn * v.head<2>();
  PlanRing turned_corners;
  for (const auto& corner : corners) turned_corners.emplace_back(turn * corner);
  const FloorPlan oblique = plan_of(turned);
  ASSERT_EQ(oblique.storeys.at(0).rooms.size(), 1U);
  expect_corners(oblique, oblique.storeys[0].rooms[0], turned_corners);
}

TEST(Project, RoomsOnBothSidesOfOneFaceShareItsLine) {
  MeshBuilder b;
  b.floor(0, 0, 7, 3);
  b.wall(0, 0, 7, 0);
  b.wall(7, 0, 7, 3);
  b.wall(7, 3, 0, 3);
  b.wall(0, 3, 0, 0);
  b.wall(4, 0, 4, 3);
  const FloorPlan plan = plan_of(b.mesh);
  ASSERT_EQ(plan.storeys.at(0).rooms.size(), 2U);
  expect_corners(plan, plan.storeys[0].rooms[0], {{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  expect_corners(plan, plan.storeys[0].rooms[1], {{4, 0}, {7, 0}, {7, 3}, {4, 3}});
}

TEST(Project, ACeilingThatIsNotAboveItsFloorLeavesTheHeightUnknown) {
  for (const double ceiling : {-2.6, 0.0005}) {
    MeshBuilder b;
    b.room(0, 0, 5, 4, 0, ceiling);
    std::vector<std::string> warnings;
    const FloorPlan plan = plan_of(b.mesh, {}, &warnings);
    ASSERT_FALSE(warnings.empty());
    EXPECT_NE(warnings[0].find("is not above its floor, at 0.00 m"), std::string::npos) << warnings[0];
    EXPECT_EQ(plan.storeys.at(0).height, 0);
    EXPECT_TRUE(plan.storeys[0].floor_known);
    ASSERT_EQ(plan.storeys[0].rooms.size(), 1U);
    EXPECT_EQ(plan.storeys[0].rooms[0].height, 0);
  }
}

TEST(Project, ARoomUnderACeilingThatIsTooLowIsToldOf) {
  MeshBuilder b;
  b.room(0, 0, 5, 4);
  b.room(5.2, 0, 8, 4, 0, -1);
  std::vector<std::string> warnings;
  const FloorPlan plan = plan_of(b.mesh, {}, &warnings);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("storey 0: the ceilings of 1 of 2 rooms"), std::string::npos) << warnings[0];
  EXPECT_NEAR(plan.storeys.at(0).rooms.at(0).height, 2.5, 1e-9);
  EXPECT_EQ(plan.storeys[0].rooms.at(1).height, 0);
}

TEST(Project, WithoutFloorAndWallsElevationAndHeightAreUnknown) {
  MeshBuilder only_ceiling;
  only_ceiling.ceiling(0, 0, 5, 4, 2.6);
  const auto storey = plan_of(only_ceiling.mesh).storeys.at(0);
  EXPECT_FALSE(storey.floor_known);
  EXPECT_EQ(storey.height, 0);
  EXPECT_EQ(storey.rooms.at(0).height, 0);

  MeshBuilder sunken;  // a ceiling below the foot of the walls is not where they stand
  sunken.wall(0, 0, 5, 0, 1, 3);
  sunken.ceiling(0, 0, 5, 4, 0.5);
  const FloorPlan plan = plan_of(sunken.mesh);
  EXPECT_TRUE(plan.storeys.at(0).floor_known);
  EXPECT_NEAR(plan.origin.z() + plan.storeys[0].elevation, 1, 1e-9);
  EXPECT_EQ(plan.storeys[0].height, 0);
}

TEST(Project, SingleFacesAreSeenFromTheirLeft) {
  MeshBuilder b;
  b.room(0, 0, 4, 3);
  const FloorPlan plan = plan_of(b.mesh);
  const Eigen::Vector2d middle = Eigen::Vector2d(2, 1.5) - plan.origin.head<2>();
  ASSERT_EQ(plan.storeys.at(0).walls.size(), 4U);
  for (const auto& wall : plan.storeys[0].walls) {
    EXPECT_EQ(wall.thickness, 0);
    EXPECT_TRUE(wall.outline.empty());
    const Eigen::Vector2d along = wall.to - wall.from, to_middle = middle - wall.from;
    EXPECT_GT(along.x() * to_middle.y() - along.y() * to_middle.x(), 0);
  }
}

TEST(Project, AFaceHasSeveralOppositeFacesAlongItsLength) {
  MeshBuilder b;  // one long face; behind it one at 10 cm, a stretch without, and one at 30 cm
  b.wall(0, 0, 10, 0);
  b.wall(3, -0.1, 0, -0.1);
  b.wall(10, -0.3, 6, -0.3);
  const auto storey = plan_of(b.mesh).storeys.at(0);
  const auto walls = thick(storey);
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_NEAR(walls[0].thickness, 0.1, 1e-9);
  EXPECT_NEAR((walls[0].to - walls[0].from).norm(), 3, 1e-9);
  EXPECT_NEAR(walls[1].thickness, 0.3, 1e-9);
  EXPECT_NEAR((walls[1].to - walls[1].from).norm(), 4, 1e-9);
  EXPECT_NEAR(single_length(storey), 3, 1e-9);
}

TEST(Project, FacesThatLookAtEachOtherOrTheSameWayAreNoWall) {
  MeshBuilder b;
  b.wall(0, 0, 4, 0);        // seen from above
  b.wall(4, 0.2, 0, 0.2);    // seen from below: a passage of 20 cm between them
  b.wall(0, -0.3, 4, -0.3);  // the same way as the first
  const auto storey = plan_of(b.mesh).storeys.at(0);
  EXPECT_TRUE(thick(storey).empty());
  EXPECT_EQ(storey.walls.size(), 3U);
}

TEST(Project, ThicknessLimitsHold) {
  for (const auto& [thickness, found] :
       std::vector<std::pair<double, bool>>{{0.029, false}, {0.031, true}, {0.599, true}, {0.601, false}}) {
    MeshBuilder b;
    b.wall(0, 0, 4, 0);
    b.wall(4, -thickness, 0, -thickness);
    EXPECT_EQ(thick(plan_of(b.mesh).storeys.at(0)).size(), found ? 1U : 0U) << thickness;
  }
}

TEST(Project, CornersAndJunctionsOfWallsAreClosed) {
  MeshBuilder b;  // an L of 20 cm walls whose ends stop short of the corner, and a T into its long leg
  b.wall(0, 0.2, 5.7, 0.2);
  b.wall(5.7, 0, 0, 0);
  b.wall(6, 3, 6, 0.3);
  b.wall(5.8, 0.3, 5.8, 3);
  b.wall(2.1, 3, 2.1, 0.35);
  b.wall(1.9, 0.35, 1.9, 3);
  const auto storey = plan_of(b.mesh).storeys.at(0);
  ASSERT_EQ(storey.bodies.size(), 1U);
  EXPECT_TRUE(storey.bodies[0].holes.empty());
  EXPECT_EQ(storey.bodies[0].outline.size(), 10U);  // six of the L, four more of the T
  EXPECT_NEAR(storey.bodies[0].area(), 6 * 0.2 + 2.8 * 0.2 + 2.8 * 0.2, 1e-3);
}

TEST(Project, ADoorDividesRoomsAndAWidePassageDoesNot) {
  for (const double width : {0.9, 2.0}) {
    MeshBuilder b;
    b.floor(0, 0, 8.1, 4);
    b.wall(4, 0, 4, 1);
    b.wall(4, 1 + width, 4, 4, 0, 2.5, false);
    b.wall(4, 1, 4, 1 + width, 2, 2.5, false);
    b.wall(4.1, 4, 4.1, 1 + width);
    b.wall(4.1, 1, 4.1, 0, 0, 2.5, false);
    EXPECT_EQ(plan_of(b.mesh).storeys.at(0).rooms.size(), width < 1.25 ? 2U : 1U) << width;
  }
}

TEST(Project, WallsAreCutAtTheHeightOfTheSection) {
  MeshBuilder b;  // a slanted wall: 0.5 m further out per metre of height
  b.floor(0, 0, 4, 4);
  b.add(SurfaceClass::wall, {{4, 0, 0}, {4, 4, 0}, {5, 4, 2}, {5, 0, 2}});
  b.wall(0, 0, 3, 0, 0, 0.8);  // does not reach the section
  Project::Params params;
  params.corner_gap = 0;
  for (const double height : {0.5, 1.2}) {
    params.cut_height = height;
    const FloorPlan plan = plan_of(b.mesh, params);
    ASSERT_EQ(plan.storeys.at(0).walls.size(), 2U);
    EXPECT_NEAR(plan.origin.x() + plan.storeys[0].walls[0].from.x(), 4 + 0.5 * height, 1e-9);
  }
}

TEST(Project, StoreysLieAboveEachOther) {
  MeshBuilder b;
  b.room(0, 0, 4, 3, 0, 2.5);
  b.storey = 1;
  b.room(0, 0, 4, 3, 2.8, 5.2);
  b.room(4.2, 0, 8, 3, 2.8, 5.2);
  const FloorPlan plan = plan_of(b.mesh);
  ASSERT_EQ(plan.storeys.size(), 2U);
  EXPECT_NEAR(plan.storeys[1].elevation - plan.storeys[0].elevation, 2.8, 1e-9);
  EXPECT_NEAR(plan.storeys[1].height, 2.4, 1e-9);
  ASSERT_EQ(plan.storeys[1].rooms.size(), 2U);
  EXPECT_EQ(plan.storeys[1].rooms[1].name, "Room 3");
}

TEST(Project, HolesOfFloorsAreKeptAndPiecesJoined) {
  MeshBuilder b;
  b.floor(0, 0, 6, 2);
  b.floor(0, 4, 6, 6);
  b.floor(0, 2, 2, 4);
  b.floor(4, 2, 6, 4);
  const auto storey = plan_of(b.mesh).storeys.at(0);
  ASSERT_EQ(storey.floors.size(), 1U);
  EXPECT_EQ(storey.floors[0].outline.size(), 4U);
  ASSERT_EQ(storey.floors[0].holes.size(), 1U);
  EXPECT_NEAR(storey.floors[0].area(), 32, 1e-3);
}

TEST(Project, MovedByUtmOffsetsThePlanIsTheSame) {
  const Mesh mesh = two_rooms();
  Mesh moved = mesh;
  moved.origin += Eigen::Vector3d(500000.25, 5400000.5, 300.125);
  const FloorPlan a = plan_of(mesh), b = plan_of(moved);
  ASSERT_EQ(a.storeys[0].walls.size(), b.storeys[0].walls.size());
  const Eigen::Vector3d shift = b.origin - a.origin;
  for (std::size_t i = 0; i < a.storeys[0].walls.size(); ++i) {
    const Eigen::Vector2d off = shift.head<2>() + b.storeys[0].walls[i].from - a.storeys[0].walls[i].from;
    EXPECT_NEAR(off.x(), 500000.25, 1e-6);
    EXPECT_NEAR(off.y(), 5400000.5, 1e-6);
  }
  EXPECT_NEAR(b.origin.z() + b.storeys[0].elevation, 300.125, 1e-9);
  EXPECT_LT(b.storeys[0].walls[0].from.norm(), 10);  // near its origin
}

TEST(Project, ATiltedModelIsTurnedUprightAboutItsOrigin) {
  const Eigen::AngleAxisd tilt(0.1, Eigen::Vector3d(1, 2, 0).normalized());
  Mesh mesh = two_rooms();
  mesh.origin = {1000, 2000, 30};
  for (auto& v : mesh.vertices) v = tilt * v;
  const FloorPlan plan = plan_of(mesh);
  const auto storey = plan.storeys.at(0);
  ASSERT_EQ(storey.rooms.size(), 2U);
  EXPECT_NEAR(storey.rooms[0].polygon.area(), 12, 1e-5);
  EXPECT_NEAR(thick(storey).at(0).thickness, 0.12, 1e-6);
  EXPECT_NEAR((plan.to_plan.rotation * plan.origin + plan.to_plan.translation - plan.origin).norm(), 0, 1e-6);
  EXPECT_NEAR((plan.to_plan.rotation * (tilt * Eigen::Vector3d::UnitZ())).z(), 1, 1e-9);
  // The same by the transform of an alignment, whatever its turn about z.
  Transform aligned;
  aligned.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) * tilt.inverse();
  const FloorPlan same = plan_of(mesh, {}, nullptr, input(aligned));
  EXPECT_TRUE(same.to_plan.rotation.isApprox(plan.to_plan.rotation, 1e-9));
}

TEST(Project, WithinTheToleranceNothingIsTurned) {
  Mesh mesh = two_rooms();
  for (auto& v : mesh.vertices) v = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitX()) * v;
  EXPECT_EQ(plan_of(mesh).to_plan.rotation, Eigen::Matrix3d::Identity());
}

TEST(Project, TrianglesWithoutPrimitivesAreJoinedToFaces) {
  Mesh mesh = two_rooms();
  const FloorPlan with = plan_of(mesh);
  mesh.primitives.clear();
  const FloorPlan plan = plan_of(mesh);
  ASSERT_EQ(plan.storeys.at(0).walls.size(), with.storeys.at(0).walls.size());
  EXPECT_TRUE(plan.storeys[0].walls[0].primitives.empty());
}

TEST(Project, EmptyAndOddModelsHaveDefinedAnswers) {
  std::vector<std::string> warnings;
  EXPECT_TRUE(plan_of({}, {}, &warnings).storeys.empty());
  EXPECT_EQ(warnings.size(), 1U);

  MeshBuilder one_wall;
  one_wall.wall(0, 0, 4, 0);
  auto plan = plan_of(one_wall.mesh, {}, &warnings);
  EXPECT_EQ(plan.storeys.at(0).walls.size(), 1U);
  EXPECT_EQ(plan.storeys[0].height, 0);
  EXPECT_EQ(warnings.size(), 1U);  // no rooms

  MeshBuilder only_floor;
  only_floor.floor(0, 0, 4, 3);
  plan = plan_of(only_floor.mesh, {}, &warnings);
  EXPECT_EQ(plan.storeys.at(0).rooms.size(), 1U);
  EXPECT_EQ(plan.storeys[0].rooms[0].height, 0);
  EXPECT_EQ(warnings.size(), 1U);  // no walls

  MeshBuilder no_floor;
  no_floor.ceiling(0, 0, 4, 3);
  no_floor.wall(0, 0, 4, 0, 1.5, 2.5);
  plan = plan_of(no_floor.mesh, {}, &warnings);
  EXPECT_EQ(plan.storeys.at(0).rooms.size(), 1U);
  EXPECT_EQ(plan.storeys[0].walls.size(), 1U);
  EXPECT_NEAR(plan.storeys[0].height, 1, 1e-9);
  EXPECT_EQ(warnings.size(), 1U);  // rooms from ceilings

  MeshBuilder slivers;
  slivers.floor(0, 0, 4, 0.3);
  slivers.floor(0, 2, 0.9, 2.9);
  EXPECT_TRUE(plan_of(slivers.mesh).storeys.at(0).rooms.empty());

  MeshBuilder degenerate;
  degenerate.room(0, 0, 4, 3);
  degenerate.add(SurfaceClass::floor, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  degenerate.add(SurfaceClass::wall, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  plan = plan_of(degenerate.mesh, {}, &warnings);
  EXPECT_EQ(plan.storeys.at(0).walls.size(), 4U);
  EXPECT_EQ(warnings.size(), 1U);

  MeshBuilder objects;
  objects.add(SurfaceClass::object, {{0, 0, 0}, {1, 0, 0}, {1, 0, 2}});
  EXPECT_TRUE(plan_of(objects.mesh).storeys.empty());
}

TEST(Project, WrongInputIsAnError) {
  Mesh mesh = two_rooms();
  mesh.classes.clear();
  EXPECT_NE(error_of(mesh).find("no classes"), std::string::npos);
  mesh = two_rooms();
  mesh.storeys.pop_back();
  EXPECT_NE(error_of(mesh).find("storeys"), std::string::npos);
  mesh = two_rooms();
  mesh.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(mesh), "vertex 3 of the mesh is not finite");
  mesh = two_rooms();
  mesh.triangles[1][2] = 1000000;
  EXPECT_NE(error_of(mesh).find("triangle 1"), std::string::npos);
  mesh = two_rooms();
  for (auto& v : mesh.vertices) v *= 1e4;
  EXPECT_NE(error_of(mesh).find("m wide"), std::string::npos);
  Project::Params params;
  params.min_thickness = 1;
  EXPECT_NE(error_of(two_rooms(), params).find("min_thickness"), std::string::npos);
}

}  // namespace
}  // namespace atrium::floorplan::project_test
