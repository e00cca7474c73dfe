#include <gtest/gtest.h>

#include <limits>

#include "modules/baseline/quadric.hpp"
#include "modules/baseline/vertex_clustering.hpp"
#include "tests/unit/baseline/meshes.hpp"

namespace atrium::baseline::decimation_test {
namespace {

using Representative = VertexClustering::Representative;

VertexClustering::Out clustered(const Mesh& mesh, const VertexClustering::Params& params) {
  Context context;
  return VertexClustering::run({input(mesh)}, params, context);
}
Mesh collapsed(const Mesh& mesh, const Quadric::Params& params) {
  Context context;
  return Quadric::run({input(mesh)}, params, context).mesh;
}

TEST(VertexClustering, NoVertexMovesFurtherThanTheDiagonalOfACube) {
  const Mesh ball = sphere(Vector3d(3, -2, 1), 1, 40);
  for (const auto representative : {Representative::mean, Representative::quadric})
    for (const double cell : {0.05, 0.2, 0.7}) {
      const Mesh mesh = clustered(ball, {cell, 0, 0, representative}).mesh;
      ASSERT_FALSE(mesh.triangles.empty());
      EXPECT_LT(mesh.triangles.size(), ball.triangles.size());
      EXPECT_LE(greatest_distance(mesh, ball), cell * std::sqrt(3.0));
      EXPECT_LE(greatest_distance(ball, mesh), cell * std::sqrt(3.0));
    }
}

TEST(VertexClustering, AFlatPlaneStaysFlatAndItsMeansAreKnown) {
  Mesh plane;
  add_grid(plane, Vector3d(0, 0, 1), Vector3d(4, 0, 0), Vector3d(0, 4, 0), 8);
  const auto out = clustered(plane, {1.999, 0, 0});
  EXPECT_EQ(out.mesh.vertices.size(), 9U);  // cells [0, 2), [2, 4), [4, …) along x and y
  EXPECT_EQ(out.mesh.triangles.size(), 8U);
  EXPECT_EQ(out.cell_size, 1.999);
  for (const auto& v : out.mesh.vertices) EXPECT_DOUBLE_EQ(v.z(), 1);
}

TEST(VertexClustering, TheQuadricRepresentativeFindsTheCornersOfABox) {
  const Mesh mesh = clustered(box(Vector3d(3, 3, 3), 30), {0.77, 0, 0, Representative::quadric}).mesh;
  for (const double x : {0.0, 3.0})
    for (const double y : {0.0, 3.0})
      for (const double z : {0.0, 3.0}) {
        double least = 1;
        for (const auto& v : mesh.vertices) least = std::min(least, (v - Vector3d(x, y, z)).norm());
        EXPECT_LT(least, 1e-9);
      }
}

TEST(VertexClustering, ATargetGivesTheFinestGridThatKeepsIt) {
  const Mesh ball = sphere(Vector3d::Zero(), 1, 40);
  for (const int target : {12, 100, 1000, 5000}) {
    const auto out = clustered(ball, {0, target, 0});
    EXPECT_LE(out.mesh.triangles.size(), static_cast<std::size_t>(target));
    EXPECT_GT(out.mesh.triangles.size(), static_cast<std::size_t>(target) / 4);
    EXPECT_EQ(content_hash(clustered(ball, {out.cell_size, 0, 0}).mesh), content_hash(out.mesh));
  }
  EXPECT_EQ(clustered(ball, {0.3, 5000, 0}).cell_size, 0.3);  // coarse enough already
  EXPECT_LE(clustered(ball, {0, 0, 0.1}).mesh.triangles.size(), ball.triangles.size() / 10);
}

TEST(VertexClustering, KeepsColumnsAndOrigin) {
  Mesh plane;
  add_grid(plane, Vector3d::Zero(), Vector3d(4, 0, 0), Vector3d(0, 4, 0), 8);
  plane.origin = {5e5, 5.4e6, 100};
  plane.colours.assign(plane.vertices.size(), Colour{10, 20, 30});
  for (std::size_t i = 0; i < plane.triangles.size(); ++i) {
    plane.classes.push_back(SurfaceClass::floor);
    plane.primitives.push_back(7);
    plane.storeys.push_back(2);
  }
  const Mesh mesh = clustered(plane, {1.5, 0, 0}).mesh;
  ASSERT_FALSE(mesh.triangles.empty());
  EXPECT_EQ(mesh.origin, plane.origin);
  EXPECT_EQ(mesh.colours, std::vector<Colour>(mesh.vertices.size(), Colour{10, 20, 30}));
  EXPECT_EQ(mesh.primitives, std::vector<std::int32_t>(mesh.triangles.size(), 7));
  EXPECT_EQ(mesh.storeys, std::vector<std::int32_t>(mesh.triangles.size(), 2));
  EXPECT_EQ(mesh.classes, std::vector<SurfaceClass>(mesh.triangles.size(), SurfaceClass::floor));
}

TEST(VertexClustering, ClassesThatAreAllObjectsAreLeftOut) {
  Mesh cube = box(Vector3d(1, 1, 1), 4);
  cube.classes.assign(cube.triangles.size(), SurfaceClass::object);
  EXPECT_TRUE(clustered(cube, {0.4, 0, 0}).mesh.classes.empty());
  cube.classes.back() = SurfaceClass::wall;
  EXPECT_FALSE(clustered(cube, {0.4, 0, 0}).mesh.classes.empty());
}

TEST(VertexClustering, SameBytesWithAnyNumberOfThreads) {
  const Mesh ball = sphere(Vector3d::Zero(), 1, 60);
  EXPECT_TRUE(same_with_any_threads([&] { return content_hash(clustered(ball, {0, 900, 0}).mesh); }));
}

TEST(Quadric, ReachesItsTargetAndStaysNearAndClosed) {
  const Mesh ball = sphere(Vector3d(100, 200, 300), 1, 30);
  for (const int target : {2000, 500, 100}) {
    const Mesh mesh = collapsed(ball, {target, 0});
    EXPECT_LE(mesh.triangles.size(), static_cast<std::size_t>(target));
    EXPECT_GE(mesh.triangles.size() + 2, static_cast<std::size_t>(target));
    EXPECT_EQ(validity(mesh, "closed"), 1);
    EXPECT_EQ(validity(mesh, "edges.non_manifold"), 0);
    EXPECT_EQ(validity(mesh, "edges.misoriented"), 0);
    EXPECT_LT(greatest_distance(mesh, ball), 5.0 / target);
    EXPECT_NEAR(volume(mesh), volume(ball), 20.0 / target);
  }
}

TEST(Quadric, ABoxIsLeftWithItsCorners) {
  const Mesh mesh = collapsed(box(Vector3d(4, 5, 2.5), 10), {12, 0});
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_NEAR(volume(mesh), 50, 1e-6);
}

TEST(Quadric, KeepsTheBorderOfAnOpenSheet) {
  Mesh sheet;
  add_grid(sheet, Vector3d::Zero(), Vector3d(4, 0, 0), Vector3d(0, 3, 0), 20);
  const Mesh mesh = collapsed(sheet, {20, 0});
  EXPECT_LE(mesh.triangles.size(), 20U);
  EXPECT_NEAR(area(mesh), 12, 1e-6);
}

TEST(Quadric, KeepsOriginAndColoursAndDropsTheRest) {
  Mesh ball = sphere(Vector3d::Zero(), 1, 10);
  ball.origin = {5e5, 5.4e6, 100};
  for (const auto& v : ball.vertices) ball.colours.push_back(v.x() > 0 ? Colour{255, 0, 0} : Colour{0, 0, 255});
  ball.primitives.assign(ball.triangles.size(), 3);
  const Mesh mesh = collapsed(ball, {0, 0.25});
  EXPECT_EQ(mesh.origin, ball.origin);
  EXPECT_TRUE(mesh.primitives.empty());
  ASSERT_EQ(mesh.colours.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_TRUE(std::abs(mesh.vertices[i].x()) < 0.2 || mesh.colours[i][0] == (mesh.vertices[i].x() > 0 ? 255 : 0));
}

TEST(Quadric, FewEnoughTrianglesStayAsTheyAre) {
  Mesh cube = box(Vector3d(1, 1, 1), 2);
  EXPECT_EQ(content_hash(collapsed(cube, {1000, 0})), content_hash(collapsed(cube, {48, 0})));
  EXPECT_EQ(collapsed(cube, {48, 0}).triangles, cube.triangles);
}

TEST(Quadric, TakesWhatIsNoManifold) {
  Mesh fan;  // three sheets on one edge, a repeated triangle, one with a repeated corner
  for (const auto& out : {Vector3d(1, 0, 0), Vector3d(-1, 0.2, 0), Vector3d(0.1, 1, 0)})
    add_grid(fan, Vector3d::Zero(), out, Vector3d(0, 0, 1), 6);
  fan = welded(fan);
  fan.triangles.push_back(fan.triangles.front());
  fan.triangles.push_back({0, 1, 1});
  for (const int target : {100, 20, 1}) EXPECT_LE(collapsed(fan, {target, 0}).triangles.size(), 100U);
}

TEST(Decimation, BadInputIsAnError) {
  Mesh cube = box(Vector3d(1, 1, 1), 2);
  EXPECT_NE(error_of([&] { clustered(cube, {}); }).find("neither"), std::string::npos);
  EXPECT_NE(error_of([&] { collapsed(cube, {}); }).find("neither"), std::string::npos);
  Mesh holed = cube;
  holed.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([&] { clustered(holed, {0.1}); }).find("vertex 3"), std::string::npos);
  EXPECT_NE(error_of([&] { collapsed(holed, {10}); }).find("vertex 3"), std::string::npos);
  Mesh wild = cube;
  wild.triangles[5][1] = 1000;
  EXPECT_NE(error_of([&] { clustered(wild, {0.1}); }).find("triangle 5"), std::string::npos);
  EXPECT_NE(error_of([&] { collapsed(wild, {10}); }).find("triangle 5"), std::string::npos);
  Mesh lame = cube;
  lame.classes.resize(3);
  EXPECT_NE(error_of([&] { clustered(lame, {0.1}); }).find("3 classes"), std::string::npos);
  EXPECT_NE(error_of([&] { collapsed(lame, {10}); }).find("3 classes"), std::string::npos);
}

TEST(Decimation, NothingGivesNothing) {
  Mesh empty;
  empty.origin = {1, 2, 3};
  EXPECT_EQ(clustered(empty, {0.1}).mesh.origin, empty.origin);
  EXPECT_TRUE(clustered(empty, {0, 10}).mesh.triangles.empty());
  EXPECT_TRUE(collapsed(empty, {10}).triangles.empty());
  Mesh spot;
  spot.vertices.assign(3, Vector3d(1, 1, 1));
  spot.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_TRUE(clustered(spot, {0.1}).mesh.triangles.empty());
  EXPECT_LE(collapsed(spot, {1}).triangles.size(), 2U);
}

}  // namespace
}  // namespace atrium::baseline::decimation_test
