#include "modules/scene/unclassify.hpp"

#include <gtest/gtest.h>

namespace atrium::scene::unclassify_test {
namespace {

TEST(SceneUnclassify, KeepsTheSurfaceAndNothingThatNamesIt) {
  Mesh mesh;
  mesh.origin = {1, 2, 3};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  mesh.triangles = {{0, 1, 2}};
  mesh.classes = {SurfaceClass::object};
  mesh.storeys = {0};
  mesh.primitives = {7};
  Context context;
  const Mesh result = Unclassify::run({input(mesh)}).mesh;
  EXPECT_EQ(result.origin, mesh.origin);
  EXPECT_EQ(result.vertices, mesh.vertices);
  EXPECT_EQ(result.triangles, mesh.triangles);
  EXPECT_EQ(result.colours.size(), 3U);
  EXPECT_TRUE(result.classes.empty() && result.storeys.empty() && result.primitives.empty());
}

}  // namespace
}  // namespace atrium::scene::unclassify_test
