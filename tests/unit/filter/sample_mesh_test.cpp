#include "modules/filter/sample_mesh.hpp"

#include <gtest/gtest.h>

namespace atrium::filter::sample_mesh_test {
namespace {

TEST(SampleMesh, AsManyPointsAsVerticesUnlessTold) {
  Context context;
  Mesh mesh;
  mesh.origin = {1, 2, 3};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Cloud cloud = SampleMesh::run({input(mesh)}, {}, context).cloud;
  EXPECT_EQ(cloud.size(), 4U);
  EXPECT_EQ(cloud.origin, mesh.origin);
  EXPECT_TRUE(cloud.has_normals());
  EXPECT_EQ(SampleMesh::run({input(mesh)}, {500}, context).cloud.size(), 500U);
  EXPECT_THROW(SampleMesh::run({input(Mesh{})}, {500}, context), Error);
}

}  // namespace
}  // namespace atrium::filter::sample_mesh_test
