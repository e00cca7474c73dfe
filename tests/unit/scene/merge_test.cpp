#include "modules/scene/merge.hpp"

#include <gtest/gtest.h>

#include "modules/geometry/polygon.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::scene::merge_test {
namespace {

using Eigen::Vector3d;

PlaneMeshes some_meshes() {
  PlaneMeshes meshes;
  meshes.origin = {10, 20, 30};
  meshes.meshes.push_back(
      {3, SurfaceClass::floor, 0, {Vector3d::UnitZ(), 0}, {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 4, 0}, {0, 3, 0}}});
  meshes.meshes.push_back(
      {1, SurfaceClass::ceiling, 1, {-Vector3d::UnitZ(), 2}, {{0, 0, 2}, {0, 3, 2}, {4, 3, 2}, {4, 0, 2}}});
  meshes.meshes.push_back(
      {7, SurfaceClass::wall, 1, {Vector3d::UnitY(), 0}, {{0, 0, 0}, {0, 0, 2}, {4, 0, 2}, {4, 0, 0}}});
  return meshes;
}

Mesh some_object() {
  Mesh mesh;
  mesh.origin = {11, 20, 30};
  mesh.vertices = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Vector3d place(const Mesh& mesh, std::size_t i) { return mesh.origin + mesh.vertices[i]; }

void expect_full_columns(const Mesh& mesh) {
  EXPECT_EQ(mesh.classes.size(), mesh.triangles.size());
  EXPECT_EQ(mesh.storeys.size(), mesh.triangles.size());
  EXPECT_EQ(mesh.primitives.size(), mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (const auto v : t) EXPECT_LT(v, mesh.vertices.size());
}

TEST(SceneMerge, EveryTriangleKeepsItsClassStoreyAndPrimitive) {
  Context context;
  const auto out = Merge::run({input(some_meshes()), input(some_object()), {}}, {});
  for (const auto* mesh : {&out.structure, &out.objects, &out.scene, &out.scene_without_ceiling})
    expect_full_columns(*mesh);
  EXPECT_EQ(out.structure.primitives, (std::vector<std::int32_t>{3, 3, 3, 1, 1, 7, 7}));
  EXPECT_EQ(out.structure.storeys, (std::vector<std::int32_t>{0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(out.structure.vertices.size(), 13U);
  EXPECT_EQ(out.scene.primitives, (std::vector<std::int32_t>{3, 3, 3, 1, 1, 7, 7, -1}));
  EXPECT_EQ(out.scene.classes.back(), SurfaceClass::object);
  EXPECT_EQ(out.scene_without_ceiling.primitives, (std::vector<std::int32_t>{3, 3, 3, 7, 7, -1}));
  EXPECT_EQ(std::count(out.scene_without_ceiling.classes.begin(), out.scene_without_ceiling.classes.end(),
                       SurfaceClass::ceiling),
            0);
  EXPECT_EQ(out.objects.storeys, std::vector<std::int32_t>{-1});
}

TEST(SceneMerge, FansKeepAreaAndSide) {
  Context context;
  const auto meshes = some_meshes();
  const auto out = Merge::run({input(meshes), {}, {}}, {});
  double area = 0;
  for (std::size_t t = 0; t < out.structure.triangles.size(); ++t) {
    const auto& tri = out.structure.triangles[t];
    const Vector3d a =
        vector_area({out.structure.vertices[tri[0]], out.structure.vertices[tri[1]], out.structure.vertices[tri[2]]});
    for (const auto& mesh : meshes.meshes)
      EXPECT_TRUE(mesh.primitive != out.structure.primitives[t] || a.dot(mesh.plane.normal) > a.norm() - 1e-12);
    area += a.norm();
  }
  EXPECT_NEAR(area, 14 + 12 + 8, 1e-9);
  EXPECT_TRUE(out.objects.vertices.empty());
}

TEST(SceneMerge, BringsOriginsTogether) {
  Context context;
  const auto out = Merge::run({input(some_meshes()), input(some_object()), {}}, {});
  const std::size_t first = out.structure.vertices.size();
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR((place(out.scene, first + i) - (some_object().origin + some_object().vertices[i])).norm(), 0, 1e-12);
  const auto only = Merge::run({input(PlaneMeshes{}), input(some_object()), {}}, {});
  EXPECT_EQ(only.scene.origin, some_object().origin);
}

TEST(SceneMerge, GoesBackToTheInputFrameUnlessTold) {
  Context context;
  Transform t;
  t.rotation =
      (Eigen::AngleAxisd(0.4, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.05, Vector3d::UnitX())).toRotationMatrix();
  t.translation = {1, 2, 3};
  PlaneMeshes meshes = some_meshes();
  const Vector3d utm(500000, 5400000, 300);
  meshes.origin = t.rotation * utm + t.translation;
  const auto out = Merge::run({input(meshes), {}, input(t)}, {});
  EXPECT_NEAR((out.structure.origin - utm).norm(), 0, 1e-6);
  for (std::size_t i = 0; i < out.structure.vertices.size(); ++i) {
    const Vector3d aligned = t.rotation * place(out.structure, i) + t.translation;
    EXPECT_LT(out.structure.vertices[i].norm(), 10);
    double nearest = 1e9;
    for (const auto& mesh : meshes.meshes)
      for (const auto& c : mesh.corners) nearest = std::min(nearest, (meshes.origin + c - aligned).norm());
    EXPECT_LT(nearest, 1e-6);
  }
  Merge::Params params;
  params.frame = Frame::aligned;
  const auto aligned = Merge::run({input(meshes), {}, input(t)}, params);
  EXPECT_EQ(aligned.structure.origin, meshes.origin);
  EXPECT_EQ(aligned.structure.vertices.front(), meshes.meshes.front().corners.front());
}

TEST(SceneMerge, ColoursByClassUnlessTold) {
  Context context;
  const auto out = Merge::run({input(some_meshes()), input(some_object()), {}}, {});
  EXPECT_EQ(out.scene.colours.size(), out.scene.vertices.size());
  EXPECT_NE(out.structure.colours.front(), out.structure.colours.back());
  Mesh painted = some_object();
  painted.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(Merge::run({input(some_meshes()), input(painted), {}}, {}).objects.colours, painted.colours);
  Merge::Params plain;
  plain.class_colours = false;
  EXPECT_TRUE(Merge::run({input(some_meshes()), input(some_object()), {}}, plain).scene.colours.empty());
  const auto mixed = Merge::run({input(some_meshes()), input(painted), {}}, plain);
  EXPECT_EQ(mixed.objects.colours, painted.colours);
  EXPECT_EQ(mixed.scene.colours.size(), mixed.scene.vertices.size());
}

TEST(SceneMerge, OfNothingIsEmpty) {
  Context context;
  const auto out = Merge::run({input(PlaneMeshes{}), {}, {}}, {});
  EXPECT_TRUE(out.scene.triangles.empty());
  EXPECT_TRUE(out.scene.vertices.empty());
}

}  // namespace
}  // namespace atrium::scene::merge_test
