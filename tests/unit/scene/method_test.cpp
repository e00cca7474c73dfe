// The steps of the method together, from primitives to the scene's mesh.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "modules/align/xy_plane.hpp"
#include "modules/align/z_axis.hpp"
#include "modules/estimate/adjacency.hpp"
#include "modules/estimate/plane_meshes.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/refine/mesh_clipping.hpp"
#include "modules/refine/vertex_translation.hpp"
#include "modules/scene/merge.hpp"
#include "modules/segment/structure.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::scene::method_test {
namespace {

using Eigen::Vector3d;

Mesh simplified(const PlanePrimitives& planes, const segment::Structure::Params& limits = {}) {
  Context context;
  auto upright = align::ZAxis::run({input(planes), {}}, {}, context);
  auto aligned = align::XyPlane::run({input(upright.planes), input(upright.transform)}, {}, context);
  auto segments = segment::Structure::run({aligned.planes}, limits, context);
  const auto structure = input(segments.structure);
  const auto meshes = input(estimate::PlaneMeshes::run({structure}, {}, context).meshes);
  const auto graph = input(estimate::Adjacency::run({meshes}, {}, context).adjacency);
  const auto closed = input(refine::VertexTranslation::run({meshes, graph}, {}).meshes);
  const auto clipped = input(refine::MeshClipping::run({closed, graph, structure}, {}, context).meshes);
  return Merge::run({clipped, {}, input(aligned.transform)}, {}).structure;
}

double area_of(const Mesh& mesh, SurfaceClass surface) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if (mesh.classes[t] == surface)
      sum += vector_area({mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}).norm();
  }
  return sum;
}

Transform pose() {
  Transform t;
  const double rad = std::numbers::pi / 180;
  t.rotation =
      (Eigen::AngleAxisd(2.5 * rad, Vector3d(1, 2, 0).normalized()) * Eigen::AngleAxisd(23 * rad, Vector3d::UnitZ()))
          .toRotationMatrix();
  t.translation = {500000, 5400000, 300};
  return t;
}

TEST(Method, AnLShapedRoomIsExact) {
  const Mesh mesh = simplified(test::l_room(0.2).planes());
  EXPECT_NEAR(area_of(mesh, SurfaceClass::wall), 22 * 2.5, 1e-3);
  EXPECT_NEAR(area_of(mesh, SurfaceClass::floor), 21, 1e-3);
  EXPECT_NEAR(area_of(mesh, SurfaceClass::ceiling), 21, 1e-3);
  EXPECT_EQ(mesh.triangles.size(), 2U * (6 + 3 + 3));
}

TEST(Method, TheResultFollowsThePoseToTheMillimetre) {
  const PlanePrimitives room = test::l_room(0.2).planes();
  const Mesh straight = simplified(room);
  const Mesh posed = simplified(transformed(room, pose()));
  const Mesh back = transformed(posed, inverse(pose()));
  ASSERT_EQ(posed.triangles, straight.triangles);
  ASSERT_EQ(posed.classes, straight.classes);
  double worst = 0;
  for (const auto& v : straight.vertices) {
    double nearest = 1e9;
    for (const auto& w : back.vertices) nearest = std::min(nearest, (straight.origin + v - back.origin - w).norm());
    worst = std::max(worst, nearest);
  }
  EXPECT_LT(worst, 1e-3);
  for (const auto& v : posed.vertices) EXPECT_LT(v.norm(), 20);  // local coordinates stay near zero
}

TEST(Method, GivesTheSameBytesWithAnyNumberOfThreads) {
  test::Rooms rooms = test::l_room(0.2);
  rooms.noise = 0.008;
  rooms.wall(3, 0.1, 3, 1.9).floor(1, 1, 2, 2, 0.7);
  const PlanePrimitives planes = transformed(rooms.planes(), pose());
  std::vector<std::string> hashes;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    hashes.push_back(content_hash(simplified(planes)));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Method, TwoStoreysKeepTheirNumbers) {
  test::Rooms rooms;
  const std::vector<Eigen::Vector2d> outline{{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  rooms.floor(0, 0, 6, 4).ceiling(0, 0, 6, 4, 2.5).walls(outline, 0.1);
  rooms.floor(0, 0, 6, 4, 2.8).ceiling(0, 0, 6, 4, 5.3).walls(outline, 0.1, 2.8, 5.3);
  const Mesh mesh = simplified(rooms.planes());
  EXPECT_EQ(std::count(mesh.storeys.begin(), mesh.storeys.end(), 0), 12);
  EXPECT_EQ(std::count(mesh.storeys.begin(), mesh.storeys.end(), 1), 12);
  EXPECT_NEAR(area_of(mesh, SurfaceClass::wall), 2 * 20 * 2.5, 1e-3);
}

TEST(Method, SlantedRoofsAreCutToTheGables) {
  test::Rooms rooms;
  rooms.floor(0, 0, 6, 4)
      .wall(0, 0, 6, 0, 0, 1.6)
      .wall(6, 4, 0, 4, 0, 1.6)
      .wall(6, 0, 6, 4, 0, 4)
      .wall(0, 4, 0, 0, 0, 4);
  rooms.add({0, 0, 1.5}, {6, 0, 0}, {0, 2, 3}, {0, 3, -2}).add({0, 4, 1.5}, {6, 0, 0}, {0, -2, 3}, {0, -3, -2});
  segment::Structure::Params limits;
  limits.slanted_ceiling_angle = 60;
  EXPECT_NEAR(area_of(simplified(rooms.planes(), limits), SurfaceClass::ceiling), 2 * 6 * std::sqrt(13.0), 0.01);
  EXPECT_EQ(area_of(simplified(rooms.planes()), SurfaceClass::ceiling), 0);
}

}  // namespace
}  // namespace atrium::scene::method_test
