#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "modules/object/greedy.hpp"
#include "modules/object/none.hpp"
#include "modules/object/poisson.hpp"
#include "modules/object/surface.hpp"
#include "tests/support/sphere.hpp"
#include "tests/support/warnings.hpp"

namespace atrium::object::object_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::sphere;

template <class Node>
Mesh mesh_of(const Cloud& cloud, typename Node::Params params = {}) {
  Context context;
  return Node::run({input(cloud)}, params, context).mesh;
}

void expect_sphere(const Mesh& mesh, double tolerance) {
  ASSERT_GT(mesh.triangles.size(), 500U);
  ASSERT_EQ(mesh.colours.size(), mesh.vertices.size());
  ASSERT_EQ(mesh.classes.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d d = mesh.vertices[i] - Vector3d(1, 2, 3);
    EXPECT_NEAR(d.norm(), 0.5, tolerance);
    EXPECT_TRUE(std::abs(d.z()) < 0.1 || mesh.colours[i][0] == (d.z() > 0 ? 255 : 0));
  }
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d n = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    EXPECT_GE(n.dot(a - Vector3d(1, 2, 3)), -1e-9);  // counter-clockwise from outside
  }
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    area += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm() / 2;
  }
  return area;
}

TEST(ObjectPoisson, ReconstructsASphere) {
  const Mesh mesh = mesh_of<Poisson>(sphere(8000), {6, 1.5, 4, 0.06});
  expect_sphere(mesh, 0.01);
  EXPECT_NEAR(area_of(mesh), std::numbers::pi, 0.05);
}

TEST(ObjectPoisson, DoesNotInventWhatWasNotSeen) {
  const Mesh mesh = mesh_of<Poisson>(sphere(8000, true), {6, 1.5, 4, 0.06});
  EXPECT_NEAR(area_of(mesh), 0.8 * std::numbers::pi, 0.15);
  for (const auto& v : mesh.vertices) EXPECT_LT(v.z(), 3.3 + 0.07);
  EXPECT_GT(area_of(mesh_of<Poisson>(sphere(8000, true), {6, 1.5, 4, 10})), 0.88 * std::numbers::pi);
}

TEST(ObjectPoisson, TakesEveryDepth) {
  for (const std::int64_t depth : {3, 4, 5, 9})
    EXPECT_FALSE(mesh_of<Poisson>(sphere(2000), {depth, 1.5, 4, 0.5}).triangles.empty());
}

/// A level square of points, `side` metres long, and a box of the same spacing far from it.
Cloud sheets_apart(double side, double apart, double spacing) {
  Cloud cloud;
  const int n = static_cast<int>(std::lround(side / spacing));
  for (const double x : {0.0, apart})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        cloud.points.emplace_back(static_cast<float>(x + spacing * i), static_cast<float>(spacing * j), 0.0F);
  cloud.normals.assign(cloud.points.size(), Vector3f::UnitZ());
  return cloud;
}

TEST(ObjectPoisson, SpacingIsThatOfTheGrid) {
  Context context;
  EXPECT_NEAR(surface_spacing(sheets_apart(1, 5, 0.02), context), 0.02, 0.003);
  EXPECT_NEAR(surface_spacing(sheets_apart(4, 5, 0.1), context), 0.1, 0.015);
  Cloud copies;
  copies.points.assign(100, Vector3f::Zero());
  EXPECT_EQ(surface_spacing(copies, context), 0);
}

TEST(ObjectPoisson, DepthFollowsTheExtentSoThatFurnitureStays) {
  for (const double apart : {10.0, 60.0}) {  // cells of 4.3 and 25.8 cm at depth 8
    const Cloud cloud = sheets_apart(1, apart, 0.02);
    const double by_spacing = area_of(mesh_of<Poisson>(cloud, {0, 1.5, 4, 0.06}));
    const double fixed = area_of(mesh_of<Poisson>(cloud, {8, 1.5, 4, 0.06}));
    EXPECT_GT(by_spacing, 1.9) << apart;
    if (apart < 20)
      EXPECT_EQ(by_spacing, fixed);
    else
      EXPECT_LT(fixed, by_spacing - 0.2);
  }
}

TEST(ObjectPoisson, TrimOfThreeSpacings) {
  const Cloud open = sphere(8000, true);  // a spacing of 1.8 cm
  Context context;
  const double spacing = surface_spacing(open, context);
  EXPECT_NEAR(spacing, std::sqrt(std::numbers::pi / 8000), 0.004);
  EXPECT_EQ(area_of(mesh_of<Poisson>(open, {6, 1.5, 4, 0})), area_of(mesh_of<Poisson>(open, {6, 1.5, 4, 3 * spacing})));
  EXPECT_LT(area_of(mesh_of<Poisson>(open, {6, 1.5, 4, 0})), area_of(mesh_of<Poisson>(open, {6, 1.5, 4, 0.2})));
}

TEST(ObjectPoisson, CopiesWithoutASpacingHaveTheUsualDepthAndTrim) {
  const Cloud once = sphere(1500);
  Cloud copies = once;
  for (int i = 1; i < 20; ++i) {
    copies.points.insert(copies.points.end(), once.points.begin(), once.points.end());
    copies.normals.insert(copies.normals.end(), once.normals.begin(), once.normals.end());
    copies.colours.insert(copies.colours.end(), once.colours.begin(), once.colours.end());
  }
  test::Warnings warnings;
  const double area = area_of(Poisson::run({input(copies)}, {0, 1.5, 4, 0}, warnings.context()).mesh);
  ASSERT_EQ(warnings.texts().size(), 1U);
  EXPECT_TRUE(warnings.texts()[0].ends_with("depth 8 and trim 0.06 m stand for those that follow it"));
  EXPECT_GT(area, 2);
  EXPECT_EQ(area, area_of(Poisson::run({input(copies)}, {8, 1.5, 4, 0.06}, warnings.context()).mesh));
  EXPECT_EQ(warnings.texts().size(), 1U);
}

TEST(ObjectPoisson, RefusesATooCoarseDepth) { EXPECT_THROW(mesh_of<Poisson>(sphere(100), {2, 1.5, 4, 0.06}), Error); }

TEST(ObjectGreedy, TriangulatesASphere) {
  const Mesh mesh = mesh_of<Greedy>(sphere(3000));
  expect_sphere(mesh, 1e-5);
  EXPECT_NEAR(area_of(mesh), std::numbers::pi, 0.3);
}

TEST(ObjectGreedy, DuplicatesByTheThousandChangeNothing) {
  const Cloud once = sphere(1000);
  Cloud often = once;
  for (int k = 0; k < 3000; ++k) {
    often.points.push_back(once.points[5]);
    often.normals.push_back(once.normals[5]);
    often.colours.push_back(once.colours[5]);
  }
  EXPECT_EQ(content_hash(mesh_of<Greedy>(often)), content_hash(mesh_of<Greedy>(once)));
}

template <class Node>
class ObjectNode : public testing::Test {};
using Nodes = testing::Types<Poisson, Greedy>;
TYPED_TEST_SUITE(ObjectNode, Nodes);

TYPED_TEST(ObjectNode, FewPointsAreNoSurface) {
  for (const int count : {0, 1, 9}) {
    Cloud cloud = sphere(count);
    cloud.origin = {500000, 5400000, 0};
    const Mesh mesh = mesh_of<TypeParam>(cloud);
    EXPECT_TRUE(mesh.triangles.empty());
    EXPECT_EQ(mesh.origin, cloud.origin);
  }
}

TYPED_TEST(ObjectNode, PointsInOnePlaceLineOrPlaneDoNoHarm) {
  for (int dimensions = 0; dimensions < 3; ++dimensions) {
    Cloud cloud;
    for (int i = 0; i < 1000; ++i) {
      cloud.points.emplace_back(dimensions > 0 ? 0.01F * static_cast<float>(i % 100) : 0.0F,
                                dimensions > 1 ? 0.01F * static_cast<float>(i) / 10 : 0.0F, 0.0F);
      cloud.normals.emplace_back(Vector3f::UnitZ());
    }
    const Mesh mesh = mesh_of<TypeParam>(cloud);
    EXPECT_TRUE(dimensions > 0 || mesh.triangles.empty());
    for (const auto& v : mesh.vertices) EXPECT_TRUE(v.allFinite());
  }
}

TYPED_TEST(ObjectNode, NeedsNormals) {
  Cloud cloud = sphere(100);
  cloud.normals.clear();
  EXPECT_THROW(mesh_of<TypeParam>(cloud), Error);
}

TYPED_TEST(ObjectNode, GivesTheSameBytesAgain) {
  const Cloud cloud = sphere(3000, true);
  EXPECT_EQ(content_hash(mesh_of<TypeParam>(cloud)), content_hash(mesh_of<TypeParam>(cloud)));
}

TEST(ObjectNone, IsEmptyAndReadsNothing) {
  EXPECT_TRUE(None::run().mesh.vertices.empty());
  EXPECT_TRUE(describe_node<None>().inputs.at(0).unused);
}

}  // namespace
}  // namespace atrium::object::object_test
