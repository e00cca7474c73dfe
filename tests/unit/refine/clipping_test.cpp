#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "modules/estimate/adjacency.hpp"
#include "modules/estimate/plane_meshes.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/refine/mesh_clipping.hpp"
#include "modules/segment/structure.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::refine::clipping_test {
namespace {

using Eigen::Vector3d;

/// The classes of primitives: horizontal ones are floors (up) or ceilings, all others walls.
Structure structure_of(const PlanePrimitives& planes) {
  Structure structure;
  structure.primitives = input(planes);
  for (const auto& p : planes.primitives) {
    const double z = p.plane.normal.z();
    structure.classes.push_back(z > 0.5 ? SurfaceClass::floor : z < -0.5 ? SurfaceClass::ceiling : SurfaceClass::wall);
  }
  structure.storeys.assign(structure.classes.size(), 0);
  return structure;
}

PlaneMeshes clipped(const PlanePrimitives& planes, std::int64_t min_points = 50) {
  Context context;
  const auto structure = input(structure_of(planes));
  const auto meshes = input(estimate::PlaneMeshes::run({structure}, {}, context).meshes);
  const auto graph = input(estimate::Adjacency::run({meshes}, {}, context).adjacency);
  return MeshClipping::run({meshes, graph, structure}, {min_points}, context).meshes;
}

double area_of(const PlaneMeshes& meshes, SurfaceClass surface) {
  double area = 0;
  for (const auto& mesh : meshes.meshes)
    if (mesh.surface == surface) area += vector_area(mesh.corners).norm();
  return area;
}

std::ptrdiff_t pieces_of(const PlaneMeshes& meshes, SurfaceClass surface) {
  return std::count_if(meshes.meshes.begin(), meshes.meshes.end(), [&](const auto& m) { return m.surface == surface; });
}

TEST(MeshClipping, CutsTheCeilingOfAnLShapedRoomToTheL) {
  const auto out = clipped(test::l_room(0).unsorted());
  EXPECT_NEAR(area_of(out, SurfaceClass::ceiling), 21, 1e-4);
  EXPECT_NEAR(area_of(out, SurfaceClass::floor), 21, 1e-4);
  EXPECT_EQ(pieces_of(out, SurfaceClass::ceiling), 3);  // never joined again
  EXPECT_EQ(pieces_of(out, SurfaceClass::wall), 6);
  for (const auto& mesh : out.meshes) {
    EXPECT_NEAR((vector_area(mesh.corners).normalized() - mesh.plane.normal).norm(), 0, 1e-9);
    const Vector3d middle = (mesh.corners[0] + mesh.corners[2]) / 2;
    EXPECT_TRUE(mesh.surface == SurfaceClass::wall || test::in_l(middle));
  }
}

/// An L room with `strays` points of the ceiling in the corner where no room is, and 70 points of it in an alcove
/// behind the wall x = 0.
PlanePrimitives room_with_strays(int strays) {
  test::Rooms rooms = test::l_room(0);
  PlanePrimitives planes = rooms.unsorted();
  Cloud cloud = *planes.cloud;
  const auto add = [&](double x, double y) {
    planes.primitives[1].inliers.push_back(static_cast<std::uint32_t>(cloud.points.size()));
    cloud.points.emplace_back(static_cast<float>(x), static_cast<float>(y), 2.5F);
    cloud.normals.emplace_back(0.0F, 0.0F, -1.0F);
  };
  Random random(1);
  for (int i = 0; i < strays; ++i) add(random.uniform(3.1, 5.9), random.uniform(2.1, 4.9));
  for (int i = 0; i < 70; ++i) add(random.uniform(-0.9, -0.1), random.uniform(2.1, 2.9));
  planes.cloud = input(cloud);
  return planes;
}

TEST(MeshClipping, ThresholdKeepsTooMuchAt25AndDropsTooMuchAt100) {
  const auto ceiling = [](std::int64_t min_points) {
    return area_of(clipped(room_with_strays(30), min_points), SurfaceClass::ceiling);
  };
  const double alcove = 0.9 * 3;  // the part of the rectangle behind x = 0 with points: y > 2
  EXPECT_NEAR(ceiling(50), 21 + alcove, 0.1);
  EXPECT_NEAR(ceiling(25), 30 + alcove, 0.1);
  EXPECT_NEAR(ceiling(100), 21, 1e-4);
}

TEST(MeshClipping, APartNeedsMorePointsThanTheThreshold) {
  EXPECT_NEAR(area_of(clipped(room_with_strays(50)), SurfaceClass::ceiling), 21 + 2.7, 0.1);
  EXPECT_NEAR(area_of(clipped(room_with_strays(51)), SurfaceClass::ceiling), 30 + 2.7, 0.1);
}

TEST(MeshClipping, AnUncutMeshIsTestedTooIfItHasANeighbouringWall) {
  test::Rooms rooms;
  rooms.spacing = 1;
  rooms.ceiling(0, 0, 5, 5).wall(0, 0, 5, 0);  // 36 points
  EXPECT_EQ(pieces_of(clipped(rooms.unsorted()), SurfaceClass::ceiling), 0);
  EXPECT_EQ(pieces_of(clipped(rooms.unsorted(), 35), SurfaceClass::ceiling), 1);
  test::Rooms alone;
  alone.spacing = 1;
  alone.ceiling(0, 0, 5, 5).wall(0, -2, 5, -2);
  EXPECT_EQ(pieces_of(clipped(alone.unsorted()), SurfaceClass::ceiling), 1);
}

TEST(MeshClipping, WallsThatAreNoNeighboursDoNotCut) {
  test::Rooms rooms;
  rooms.ceiling(0, 0, 4, 4).wall(2, 0, 2, 4, 0, 1.9).wall(0, 1, 4, 1, 0, 2.1);
  const auto out = clipped(rooms.unsorted());
  EXPECT_EQ(pieces_of(out, SurfaceClass::ceiling), 2);
  EXPECT_NEAR(area_of(out, SurfaceClass::ceiling), 16, 1e-4);
}

TEST(MeshClipping, CutsSlantedCeilings) {
  test::Rooms rooms;
  rooms.add({0, 0, 1.5}, {6, 0, 0}, {0, 2, 2}, {0, 1, -1}, [](const Vector3d& p) { return p.x() < 3.99; });
  rooms.wall(4, 0, 4, 2, 0, 3.5);
  Context context;
  PlanePrimitives planes = rooms.unsorted();
  auto structure = structure_of(planes);
  // The points end at x = 3.95: give the mesh the rectangle up to 6 that a stray point would.
  Cloud cloud = *planes.cloud;
  cloud.points[0] = {6, 0, 1.5F};
  planes.cloud = input(cloud);
  structure.primitives = input(planes);
  structure.classes = {SurfaceClass::ceiling, SurfaceClass::wall};
  const auto meshes = input(estimate::PlaneMeshes::run({input(structure)}, {}, context).meshes);
  const auto graph = input(estimate::Adjacency::run({meshes}, {}, context).adjacency);
  const auto out = MeshClipping::run({meshes, graph, input(structure)}, {}, context).meshes;
  ASSERT_EQ(pieces_of(out, SurfaceClass::ceiling), 1);
  EXPECT_NEAR(area_of(out, SurfaceClass::ceiling), 4 * std::sqrt(8.0), 1e-4);
}

TEST(MeshClipping, PiecesAreConvexDisjointAndHoldMoreThanTheThreshold) {
  Random random(23);
  for (int round = 0; round < 20; ++round) {
    test::Rooms rooms;
    rooms.ceiling(0, 0, 4, 4);
    for (int k = 0; k < 6; ++k)
      rooms.wall(random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4));
    const PlanePrimitives planes = rooms.unsorted();
    const auto out = clipped(planes, 50);
    double area_sum = 0;
    std::size_t points = 0;
    for (const auto& mesh : out.meshes) {
      if (mesh.surface != SurfaceClass::ceiling) continue;
      Polygon2 outline;
      for (auto c = mesh.corners.rbegin(); c != mesh.corners.rend(); ++c) outline.emplace_back(c->x(), c->y());
      EXPECT_TRUE(is_convex(outline, 1e-6));
      area_sum += area(outline);
      std::size_t inside = 0;
      for (const auto i : planes.primitives[0].inliers) {
        bool in = true;
        for (std::size_t k = 0; k < outline.size(); ++k) {
          const Eigen::Vector2d e = outline[(k + 1) % outline.size()] - outline[k];
          const Eigen::Vector2d d = planes.cloud->points[i].head<2>().cast<double>() - outline[k];
          in = in && e.x() * d.y() - e.y() * d.x() >= -1e-5;
        }
        inside += in ? 1 : 0;
      }
      EXPECT_GT(inside, 50U);
      points += inside;
    }
    EXPECT_LE(area_sum, 16 + 1e-6);
    EXPECT_GE(points + 50 * 64, planes.primitives[0].inliers.size());
  }
}

TEST(MeshClipping, GivesTheSameBytesWithAnyNumberOfThreads) {
  std::vector<std::string> hashes;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    hashes.push_back(content_hash(clipped(room_with_strays(30))));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(MeshClipping, RefusesForeignGraphsAndStructures) {
  Context context;
  const auto structure = input(structure_of(test::box_room().unsorted()));
  const auto meshes = input(estimate::PlaneMeshes::run({structure}, {}, context).meshes);
  const auto graph = input(estimate::Adjacency::run({meshes}, {}, context).adjacency);
  EXPECT_THROW(MeshClipping::run({meshes, input(Adjacency{}), structure}, {}, context), Error);
  EXPECT_THROW(MeshClipping::run({meshes, graph, input(Structure{})}, {}, context), Error);
}

}  // namespace
}  // namespace atrium::refine::clipping_test
