#include "modules/scene/join.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "modules/types/palette.hpp"

namespace atrium::scene::join_test {
namespace {

/// A floor, a ceiling over it that shares one corner, at a far origin.
Mesh structure() {
  Mesh mesh;
  mesh.origin = {500000, 5400000, 100};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {0, 1, 2}};
  mesh.triangles = {{0, 3, 4}, {0, 1, 2}};
  mesh.classes = {SurfaceClass::ceiling, SurfaceClass::floor};
  mesh.storeys = {0, 0};
  mesh.primitives = {4, 7};
  return mesh;
}
Mesh chair() {
  Mesh mesh;
  mesh.origin = {500001, 5400000, 100};
  mesh.vertices = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Join::Out join(const Mesh& structure, OptionalInput<Mesh> objects = {}, OptionalInput<Transform> transform = {}) {
  Context context;
  return Join::run({input(structure), std::move(objects), std::move(transform)});
}

TEST(Join, HasTheStructureFirstAndTheObjectsAfterIt) {
  const auto out = join(structure(), input(chair()));
  ASSERT_EQ(out.scene.triangles.size(), 3U);
  EXPECT_EQ(out.scene.origin, structure().origin);
  EXPECT_EQ(out.scene.triangles[2], (std::array<std::uint32_t, 3>{5, 6, 7}));
  EXPECT_EQ(out.scene.vertices[5], Eigen::Vector3d(1, 0, 0)) << "relative to the structure's origin";
  EXPECT_EQ(out.scene.classes, (std::vector{SurfaceClass::ceiling, SurfaceClass::floor, SurfaceClass::object}));
  EXPECT_EQ(out.scene.primitives, (std::vector<std::int32_t>{4, 7, -1}));
  EXPECT_EQ(out.scene.storeys, (std::vector<std::int32_t>{0, 0, -1}));
}

TEST(Join, WithoutCeilingsTheirVerticesGoToo) {
  const auto out = join(structure(), input(chair()));
  ASSERT_EQ(out.scene_without_ceiling.triangles.size(), 2U);
  EXPECT_EQ(out.scene_without_ceiling.vertices.size(), 6U);
  EXPECT_EQ(out.scene_without_ceiling.classes, (std::vector{SurfaceClass::floor, SurfaceClass::object}));
  EXPECT_EQ(out.scene_without_ceiling.primitives, (std::vector<std::int32_t>{7, -1}));
}

TEST(Join, ObjectsAreMovedIntoTheStructuresFrame) {
  Transform transform;  // from the structure's frame to that of the objects
  transform.rotation = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  transform.translation = {3, 2, 1};
  const Mesh moved = transformed(chair(), transform);
  const auto out = join(structure(), input(moved), input(transform));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((out.objects.origin + out.objects.vertices[i] - chair().origin - chair().vertices[i]).norm(), 1e-6);
}

TEST(Join, AMeshHasColoursForAllOrForNone) {
  EXPECT_TRUE(join(structure(), input(chair())).scene.colours.empty());
  Mesh red = chair();
  red.colours.assign(3, {255, 0, 0});
  const auto out = join(structure(), input(red));
  ASSERT_EQ(out.scene.colours.size(), out.scene.vertices.size());
  EXPECT_EQ(out.scene.colours[1], class_colour(SurfaceClass::floor));
  EXPECT_EQ(out.scene.colours[5], (Colour{255, 0, 0}));
  EXPECT_EQ(out.scene_without_ceiling.colours.size(), out.scene_without_ceiling.vertices.size());
  Mesh coloured = structure();
  coloured.colours.assign(5, {1, 2, 3});
  EXPECT_EQ(join(coloured, input(chair())).scene.colours.back(), class_colour(SurfaceClass::object));
}

TEST(Join, AStructureAloneIsTheScene) {
  const auto out = join(structure());
  EXPECT_EQ(content_hash(out.scene), content_hash(structure()));
  EXPECT_TRUE(out.objects.triangles.empty());
}

TEST(Join, AStructureWithoutClassesIsAnError) {
  Mesh mesh = structure();
  mesh.classes.clear();
  EXPECT_THROW(join(mesh), Error);
  mesh = structure();
  mesh.triangles[0][0] = 9;
  EXPECT_THROW(join(mesh), Error);
}

}  // namespace
}  // namespace atrium::scene::join_test
