#include "modules/metric/faces.hpp"

#include <gtest/gtest.h>

#include "meshes.hpp"

namespace atrium::metric::faces_test {
namespace {

Metrics faces(const Mesh& mesh) {
  Context context;
  return Faces::run({input(mesh)}).metrics;
}

TEST(MetricFaces, CountsARoom) {
  const auto m = faces(room());
  EXPECT_EQ(value(m, "faces.triangles"), 12);
  EXPECT_EQ(value(m, "faces.vertices"), 24);
  EXPECT_NEAR(value(m, "faces.area"), 85, 1e-12);
  EXPECT_EQ(value(m, "faces.primitives"), 6);
  EXPECT_EQ(value(m, "faces.polygons"), 6);
  EXPECT_EQ(value(m, "faces.wall.triangles"), 8);
  EXPECT_EQ(value(m, "faces.wall.polygons"), 4);
  EXPECT_NEAR(value(m, "faces.wall.area"), 45, 1e-12);
  EXPECT_EQ(value(m, "faces.floor.primitives"), 1);
  EXPECT_FALSE(has(m, "faces.object.triangles"));
}

TEST(MetricFaces, PiecesOfOnePrimitiveAreSeveralPolygons) {
  Mesh mesh = room();
  add_rectangle(mesh, {5, 0, 0}, {1, 0, 0}, {0, 1, 0}, SurfaceClass::floor, 0);
  add_rectangle(mesh, {7, 0, 0}, {1, 0, 0}, {0, 1, 0}, SurfaceClass::object, -1);
  mesh.vertices.push_back({9, 9, 9});  // of no triangle
  const auto m = faces(mesh);
  EXPECT_EQ(value(m, "faces.vertices"), 32);
  EXPECT_EQ(value(m, "faces.primitives"), 6);
  EXPECT_EQ(value(m, "faces.polygons"), 7);
  EXPECT_EQ(value(m, "faces.floor.polygons"), 2);
  EXPECT_EQ(value(m, "faces.object.polygons"), 0);
  EXPECT_EQ(value(m, "faces.object.triangles"), 2);
}

TEST(MetricFaces, PlainEmptyAndBrokenMeshes) {
  Mesh plain = room();
  plain.classes.clear();
  plain.primitives.clear();
  EXPECT_EQ(faces(plain).values.size(), 3U);
  EXPECT_EQ(value(faces({}), "faces.triangles"), 0);
  plain.triangles[3][0] = 24;
  EXPECT_THROW(faces(plain), Error);
  Mesh broken = room();
  broken.vertices[0].x() = std::nan("");
  EXPECT_THROW(faces(broken), Error);
  broken = room();
  broken.primitives.push_back(0);
  EXPECT_THROW(faces(broken), Error);
}

}  // namespace
}  // namespace atrium::metric::faces_test
