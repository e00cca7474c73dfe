#include <gtest/gtest.h>

#include "modules/estimate/adjacency.hpp"
#include "modules/estimate/plane_meshes.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/refine/none.hpp"
#include "modules/refine/vertex_translation.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::refine::translation_test {
namespace {

using Eigen::Vector3d;

PlaneMeshes wall_meshes(const test::Rooms& rooms) {
  Context context;
  Structure structure;
  structure.primitives = input(rooms.unsorted());
  structure.classes.assign(structure.primitives->primitives.size(), SurfaceClass::wall);
  structure.storeys.assign(structure.classes.size(), 0);
  return estimate::PlaneMeshes::run({input(structure)}, {}, context).meshes;
}

VertexTranslation::Out translated(const PlaneMeshes& meshes, double limit = 0.5, double parallel = 0.001) {
  Context context;
  const auto graph = estimate::Adjacency::run({input(meshes)}, {limit}, context).adjacency;
  return VertexTranslation::run({input(meshes), input(graph)}, {limit, parallel});
}

/// How many corners of the meshes stand on the vertical line through (x, y).
int corners_at(const PlaneMeshes& meshes, double x, double y) {
  int found = 0;
  for (const auto& mesh : meshes.meshes)
    for (const auto& c : mesh.corners)
      if (std::hypot(c.x() - x, c.y() - y) < 1e-6) ++found;
  return found;
}

void expect_planar(const PlaneMeshes& meshes) {
  for (const auto& mesh : meshes.meshes) {
    for (const auto& corner : mesh.corners) EXPECT_NEAR(mesh.plane.signed_distance(corner), 0, 1e-9);
    EXPECT_GT(vector_area(mesh.corners).dot(mesh.plane.normal), 0);
  }
}

TEST(VertexTranslation, ClosesTheCornersOfAnLShapedRoom) {
  for (const double gap : {0.05, 0.2, 0.35}) {
    const auto out = translated(wall_meshes(test::Rooms().walls(test::l_outline(), gap)));
    expect_planar(out.meshes);
    for (const auto& corner : test::l_outline()) EXPECT_EQ(corners_at(out.meshes, corner.x(), corner.y()), 4) << gap;
    EXPECT_EQ(out.moved, 24);  // both vertices at both ends of six walls
    double length = 0;
    for (const auto& mesh : out.meshes.meshes) length += vector_area(mesh.corners).norm() / 2.5;
    EXPECT_NEAR(length, 22, 1e-5);
  }
}

TEST(VertexTranslation, DoesNotReachFurtherThanItsLimit) {
  // Ends 0.4 m before each corner are 0.57 m apart: no neighbours at 0.5 m.
  const auto meshes = wall_meshes(test::Rooms().walls(test::l_outline(), 0.4));
  EXPECT_EQ(translated(meshes).moved, 0);
  EXPECT_EQ(translated(meshes, 0.6).moved, 24);
  // Neighbours, but the edge would have to move by 0.45 m.
  const auto t = wall_meshes(test::Rooms().wall(0, 0, 4, 0).wall(4.45, 0.1, 4.45, 3));
  EXPECT_EQ(translated(t, 0.5).moved, 4);
  EXPECT_EQ(translated(t, 0.47).moved, 4);
  Context context;
  const auto graph = estimate::Adjacency::run({input(t)}, {0.5}, context).adjacency;
  const auto short_reach = VertexTranslation::run({input(t), input(graph)}, {0.44, 0.001});
  EXPECT_EQ(short_reach.moved, 2);  // only the other wall's, by 0.1 m
}

TEST(VertexTranslation, ShortensWallsThatStickOut) {
  const auto out = translated(wall_meshes(test::Rooms().wall(-0.1, 0, 4.3, 0).wall(4, -0.2, 4, 3)));
  EXPECT_EQ(corners_at(out.meshes, 4, 0), 4);
  EXPECT_EQ(corners_at(out.meshes, -0.1, 0), 2);
  expect_planar(out.meshes);
}

TEST(VertexTranslation, LeavesParallelWallsAlone) {
  const auto out = translated(wall_meshes(test::Rooms().wall(0, 0, 4, 0).wall(4, 0.12, 0, 0.12).wall(0, 0, 4, 0)));
  EXPECT_EQ(out.moved, 0);
  // |n_i × n_j| is the sine of the angle: 0.05 here.
  const auto meshes = wall_meshes(test::Rooms().wall(0, 0, 4, 0).wall(4.1, 0, 8, 0.2));
  EXPECT_EQ(translated(meshes, 0.5, 0.06).moved, 0);
  EXPECT_GT(translated(meshes, 0.5, 0.04).moved, 0);
}

TEST(VertexTranslation, AWallThatEndsAtAnothersMiddleMovesAloneAndBothSidesTouch) {
  const auto out = translated(wall_meshes(test::Rooms().wall(0, 0, 6, 0).wall(3, 0.2, 3, 4)));
  EXPECT_EQ(out.moved, 2);
  EXPECT_EQ(corners_at(out.meshes, 3, 0), 2);
}

TEST(VertexTranslation, SlantedWallsMeetOnATiltedLineAndStayPlanar) {
  test::Rooms rooms;
  rooms.wall(0, 0, 4, 0);
  rooms.add({4.1, 0.1, 0}, {0, 3, 0}, {0.25, 0, 2.5}, {-2.5, 0, 0.25});
  const auto out = translated(wall_meshes(rooms));
  expect_planar(out.meshes);
  const auto& wall = out.meshes.meshes[0];
  int on_both = 0;
  for (const auto& c : wall.corners)
    if (std::abs(out.meshes.meshes[1].plane.signed_distance(c)) < 1e-6) ++on_both;
  EXPECT_EQ(on_both, 2);
}

TEST(VertexTranslation, AnEdgeMovesAsAWholeVerticesEachOnTheirOwn) {
  test::Rooms rooms;
  rooms.wall(0, 0, 4, 0);  // its end is 0.1 m from the slanted wall at the floor, 0.725 m at the ceiling
  rooms.add({4.1, 0.1, 0}, {0, 3, 0}, {0.625, 0, 2.5}, {-2.5, 0, 0.625});
  const auto meshes = wall_meshes(rooms);
  Context context;
  const auto graph = input(estimate::Adjacency::run({input(meshes)}, {0.5}, context).adjacency);
  const auto on_the_line = [&](Moves moves, double limit) {
    const auto out = VertexTranslation::run({input(meshes), graph}, {limit, 0.001, moves});
    expect_planar(out.meshes);
    int found = 0;
    for (const auto& c : out.meshes.meshes[0].corners)
      if (std::abs(meshes.meshes[1].plane.signed_distance(c)) < 1e-6) ++found;
    return found;
  };
  EXPECT_EQ(on_the_line(Moves::edge, 0.5), 0);
  EXPECT_EQ(on_the_line(Moves::vertices, 0.5), 1);
  EXPECT_EQ(on_the_line(Moves::nearest, 0.5), 1);
  EXPECT_EQ(on_the_line(Moves::edge, 0.8), 2);
  EXPECT_EQ(on_the_line(Moves::vertices, 0.8), 2);
  EXPECT_EQ(on_the_line(Moves::nearest, 0.8), 1);
  EXPECT_EQ(on_the_line(Moves::vertices, 0.05), 0);
}

TEST(VertexTranslation, UprightWallsCloseInTheSameWayByEdgesAndByVertices) {
  const auto meshes = wall_meshes(test::Rooms().walls(test::l_outline(), 0.2));
  Context context;
  const auto graph = input(estimate::Adjacency::run({input(meshes)}, {0.5}, context).adjacency);
  const auto moved = [&](Moves moves) { return VertexTranslation::run({input(meshes), graph}, {0.5, 0.001, moves}); };
  EXPECT_EQ(content_hash(moved(Moves::edge).meshes), content_hash(moved(Moves::vertices).meshes));
  EXPECT_EQ(moved(Moves::nearest).moved, 12);  // one vertex at each end of six walls: corners stay open
}

TEST(VertexTranslation, NoMeshCollapsesAmongManyWalls) {
  Random random(17);
  for (int round = 0; round < 40; ++round) {
    test::Rooms rooms;
    rooms.spacing = 0.2;
    for (int k = 0; k < 12; ++k) {
      const Vector3d a(random.uniform(0, 1), random.uniform(0, 1), 0);
      const Vector3d d(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 0);
      const Vector3d up(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 2);
      rooms.add(a, d, up - d * (up.dot(d) / d.squaredNorm()), d.cross(up));
    }
    const auto out = translated(wall_meshes(rooms));
    expect_planar(out.meshes);
    for (const auto& mesh : out.meshes.meshes) EXPECT_GE(vector_area(mesh.corners).norm(), 1e-4);
  }
}

TEST(VertexTranslation, FloorsAreNeitherMovedNorMovedTo) {
  Context context;
  PlaneMeshes meshes = wall_meshes(test::Rooms().wall(0, 0, 4, 0, 0.1).floor(0, 0.1, 4, 3));
  meshes.meshes[1].surface = SurfaceClass::floor;
  EXPECT_EQ(translated(meshes).moved, 0);
  meshes.meshes[1].surface = SurfaceClass::wall;  // the same planes as walls do meet, on a horizontal line
  EXPECT_EQ(translated(meshes).moved, 4);
}

TEST(VertexTranslation, RefusesAGraphOfOtherMeshes) {
  Context context;
  const auto meshes = input(wall_meshes(test::Rooms().wall(0, 0, 4, 0)));
  EXPECT_THROW(VertexTranslation::run({meshes, input(Adjacency{})}, {}), Error);
  EXPECT_EQ(VertexTranslation::run({input(PlaneMeshes{}), input(Adjacency{})}, {}).moved, 0);
}

TEST(RefineNone, HandsTheMeshesOn) {
  Context context;
  const auto meshes = input(wall_meshes(test::Rooms().wall(0, 0, 4, 0)));
  EXPECT_EQ(None::run({meshes, {}, {}}).meshes, meshes);
}

}  // namespace
}  // namespace atrium::refine::translation_test
