#include <gtest/gtest.h>

#include "modules/estimate/adjacency.hpp"
#include "modules/estimate/plane_meshes.hpp"
#include "modules/geometry/polygon.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::estimate::estimate_test {
namespace {

using Eigen::Vector3d;

atrium::PlaneMeshes meshes_of(const PlanePrimitives& planes, std::vector<SurfaceClass> classes,
                              PlaneMeshes::Params params = {}) {
  Context context;
  Structure structure;
  structure.primitives = input(planes);
  structure.storeys.assign(classes.size(), 0);
  structure.classes = std::move(classes);
  return PlaneMeshes::run({input(structure)}, params, context).meshes;
}

Vector3d low(const PlaneMesh& mesh) {
  Vector3d result = mesh.corners[0];
  for (const auto& c : mesh.corners) result = result.cwiseMin(c);
  return result;
}
Vector3d high(const PlaneMesh& mesh) {
  Vector3d result = mesh.corners[0];
  for (const auto& c : mesh.corners) result = result.cwiseMax(c);
  return result;
}

void expect_sound(const PlaneMesh& mesh) {
  ASSERT_EQ(mesh.corners.size(), 4U);
  for (const auto& corner : mesh.corners) EXPECT_NEAR(mesh.plane.signed_distance(corner), 0, 1e-9);
  const Vector3d a = vector_area(mesh.corners);
  EXPECT_NEAR((a.normalized() - mesh.plane.normal).norm(), 0, 1e-9);  // counter-clockwise around the normal
}

TEST(EstimatePlaneMeshes, OfABoxAreItsFaces) {
  const PlanePrimitives room = test::box_room().unsorted();
  const auto result = meshes_of(room, {SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::wall,
                                       SurfaceClass::wall, SurfaceClass::wall, SurfaceClass::wall});
  ASSERT_EQ(result.meshes.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    expect_sound(result.meshes[i]);
    EXPECT_EQ(result.meshes[i].primitive, static_cast<int>(i));
    EXPECT_NEAR((result.meshes[i].plane.normal - room.primitives[i].plane.normal).norm(), 0, 1e-12);
  }
  EXPECT_NEAR((low(result.meshes[0]) - Vector3d(0, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((high(result.meshes[1]) - Vector3d(4, 3, 2.5)).norm(), 0, 1e-6);
  EXPECT_NEAR((low(result.meshes[2]) - Vector3d(0, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((high(result.meshes[2]) - Vector3d(4, 0, 2.5)).norm(), 0, 1e-6);
}

TEST(EstimatePlaneMeshes, NearlyAlignedPlanesBecomeAlignedAndOthersStay) {
  for (const double degrees : {0.0, 0.4, 0.6, 30.0}) {
    const double a = degrees * std::numbers::pi / 180;
    test::Rooms rooms;
    rooms.wall(0, 0, 4 * std::cos(a), 4 * std::sin(a));
    const auto mesh = meshes_of(rooms.unsorted(), {SurfaceClass::wall}).meshes.at(0);
    expect_sound(mesh);
    const bool aligned = mesh.plane.normal == Vector3d::UnitY();
    EXPECT_EQ(aligned, degrees < 0.5) << degrees;
    if (aligned) {
      EXPECT_NEAR(-mesh.plane.offset, 2 * std::sin(a), 1e-4);  // through the middle of its points
    } else {
      EXPECT_NEAR((mesh.corners[1] - mesh.corners[0]).norm(), 4, 1e-5);
    }
  }
}

TEST(EstimatePlaneMeshes, WallsKeepVerticalEdges) {
  test::Rooms rooms;
  // A triangle of points in an oblique vertical plane: the least rectangle would stand on its hypotenuse.
  rooms.add({0, 0, 0}, {3, 2, 0}, {0, 0, 2.5}, {-2, 3, 0}, [](const Vector3d& p) { return p.z() <= 2.5 * p.x() / 3; });
  const auto mesh = meshes_of(rooms.unsorted(), {SurfaceClass::wall}).meshes.at(0);
  expect_sound(mesh);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d edge = (mesh.corners[(i + 1) % 4] - mesh.corners[i]).normalized();
    EXPECT_TRUE(std::abs(edge.z()) < 1e-9 || std::abs(edge.z()) > 1 - 1e-9);
  }
}

TEST(EstimatePlaneMeshes, SlantedCeilingsGetTheLeastRectangle) {
  test::Rooms rooms;
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.5, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.6, Vector3d::UnitX())).toRotationMatrix();
  rooms.add({1, 1, 1}, turn * Vector3d(4, 0, 0), turn * Vector3d(0, 2, 0), turn * -Vector3d::UnitZ());
  const auto mesh = meshes_of(rooms.unsorted(), {SurfaceClass::ceiling}).meshes.at(0);
  expect_sound(mesh);
  EXPECT_NEAR(vector_area(mesh.corners).norm(), 8, 1e-4);
}

TEST(EstimatePlaneMeshes, TrimLeavesStrayInliersOut) {
  test::Rooms rooms;
  rooms.wall(0, 0, 4, 0);
  PlanePrimitives planes = rooms.unsorted();
  Cloud cloud = *planes.cloud;
  cloud.points[0].x() = 9;  // one point far along the wall
  planes.cloud = input(cloud);
  EXPECT_NEAR(high(meshes_of(planes, {SurfaceClass::wall}).meshes.at(0)).x(), 9, 1e-5);
  EXPECT_NEAR(high(meshes_of(planes, {SurfaceClass::wall}, {0.5, 0.002}).meshes.at(0)).x(), 4, 1e-5);
}

TEST(EstimatePlaneMeshes, PrimitivesWithoutAreaHaveNoMesh) {
  test::Rooms rooms = test::box_room();
  PlanePrimitives planes = rooms.unsorted();
  planes.primitives.resize(3);
  planes.primitives[0].inliers.clear();
  planes.primitives[1].inliers.resize(2);
  planes.primitives[2].inliers.resize(40);  // one column of points
  EXPECT_TRUE(meshes_of(planes, {SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::wall}).meshes.empty());
}

TEST(EstimateAdjacency, JoinsWhatIsNearerThanTheLimit) {
  Context context;
  test::Rooms rooms;
  rooms.wall(0, 0, 4, 0).wall(4.4, 0, 4.4, 3).wall(0, 2, 4, 2).floor(0, 0, 4, 2, -0.2);
  const auto meshes =
      meshes_of(rooms.unsorted(), {SurfaceClass::wall, SurfaceClass::wall, SurfaceClass::wall, SurfaceClass::floor});
  const auto edges = [&](double limit) {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> pairs;
    for (const auto& e : Adjacency::run({input(meshes)}, {limit}, context).adjacency.edges())
      pairs.emplace_back(e.a, e.b);
    return pairs;
  };
  using Pairs = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  EXPECT_EQ(edges(0.5), (Pairs{{0, 1}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(edges(0.3), (Pairs{{0, 3}, {2, 3}}));
  EXPECT_EQ(edges(0.1), Pairs{});
  EXPECT_EQ(edges(0), Pairs{});
  const auto all = Adjacency::run({input(meshes)}, {0.5}, context).adjacency.edges();
  EXPECT_NEAR(all[0].separation, 0.4, 1e-6);
  EXPECT_NEAR(all[1].separation, 0.2, 1e-6);
  EXPECT_NEAR(all[3].separation, std::hypot(0.4, 0.2), 1e-6);
  EXPECT_EQ(Adjacency::run({input(atrium::PlaneMeshes{})}, {0.5}, context).adjacency.vertices(), 0U);
}

}  // namespace
}  // namespace atrium::estimate::estimate_test
