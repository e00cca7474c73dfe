#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "modules/object/greedy.hpp"
#include "modules/object/poisson.hpp"
#include "modules/pcl/convex_hull.hpp"
#include "modules/pcl/greedy.hpp"
#include "modules/pcl/marching_cubes.hpp"
#include "modules/pcl/poisson.hpp"
#include "tests/support/sphere.hpp"

namespace atrium::pcl_nodes::surfaces_test {
namespace {

using Eigen::Vector3d;

/// Georeferenced.
Cloud sphere(int count, bool open = false) {
  Cloud cloud = test::sphere(count, open);
  cloud.origin = {500000, 5400000, 0};
  return cloud;
}

template <class Node>
Mesh mesh_of(const Cloud& cloud, typename Node::Params params = {}) {
  Context context;
  return Node::run({input(cloud)}, params, context).mesh;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    area += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm() / 2;
  }
  return area;
}

/// Vertices within `tolerance` of the sphere, triangles counter-clockwise from outside, all columns.
void expect_sphere(const Mesh& mesh, double tolerance) {
  ASSERT_GT(mesh.triangles.size(), 500U);
  EXPECT_EQ(mesh.colours.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.classes.size(), mesh.triangles.size());
  EXPECT_EQ(mesh.origin, Vector3d(500000, 5400000, 0));
  std::size_t inward = 0;
  for (const auto& v : mesh.vertices) EXPECT_NEAR((v - Vector3d(1, 2, 3)).norm(), 0.5, tolerance);
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d n = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    inward += n.dot(a - Vector3d(1, 2, 3)) < -1e-9 ? 1 : 0;
  }
  EXPECT_EQ(inward, 0U);
}

TEST(PclPoisson, ClosesWhatObjectPoissonCutsAway) {
  Poisson::Params params;
  params.depth = 6;
  expect_sphere(mesh_of<Poisson>(sphere(8000), params), 0.01);
  const Mesh closed = mesh_of<Poisson>(sphere(8000, true), params);
  EXPECT_GT(area_of(closed), 0.88 * std::numbers::pi);
  EXPECT_LT(area_of(mesh_of<object::Poisson>(sphere(8000, true), {6, 1.5, 4, 0.06})), 0.86 * std::numbers::pi);
}

TEST(PclPoisson, IsThatOfObjectPoissonWhereNothingIsTrimmed) {
  Poisson::Params params;
  params.depth = 6;
  params.samples_per_node = 1.5;
  EXPECT_EQ(content_hash(mesh_of<Poisson>(sphere(4000), params)),
            content_hash(mesh_of<object::Poisson>(sphere(4000), {6, 1.5, 4, 10})));
}

TEST(PclGreedy, IsThatOfObjectGreedyWithoutDuplicates) {
  Greedy::Params params;
  params.normal_consistency = true;
  const Mesh mesh = mesh_of<Greedy>(sphere(3000), params);
  expect_sphere(mesh, 1e-5);
  EXPECT_EQ(content_hash(mesh), content_hash(mesh_of<object::Greedy>(sphere(3000))));
}

TEST(PclMarchingCubes, ReconstructsASphere) {
  const Mesh mesh = mesh_of<MarchingCubes>(sphere(8000));
  expect_sphere(mesh, 0.005);
  EXPECT_NEAR(area_of(mesh), std::numbers::pi, 0.05);
}

TEST(PclMarchingCubes, IsTrimmedToThePoints) {
  const Mesh mesh = mesh_of<MarchingCubes>(sphere(8000, true));
  EXPECT_NEAR(area_of(mesh), 0.8 * std::numbers::pi, 0.25);
  for (const auto& v : mesh.vertices) EXPECT_LT(v.z(), 3.3 + 0.07);
}

TEST(PclMarchingCubes, AnOffsetSurfaceIsThatFarOutside) {
  MarchingCubes::Params params;
  params.iso_level = 0.02;
  const Mesh mesh = mesh_of<MarchingCubes>(sphere(8000), params);
  ASSERT_GT(mesh.triangles.size(), 500U);
  for (const auto& v : mesh.vertices) EXPECT_NEAR((v - Vector3d(1, 2, 3)).norm(), 0.52, 0.005);
}

TEST(PclMarchingCubes, TooManyCellsAreAnError) {
  EXPECT_THROW(mesh_of<MarchingCubes>(sphere(100), {1e-4, 0, 0.1}), Error);
}

TEST(PclConvexHull, OfASphereIsTheSphere) {
  const Mesh mesh = mesh_of<ConvexHull>(sphere(2000));
  expect_sphere(mesh, 1e-5);
  EXPECT_NEAR(area_of(mesh), std::numbers::pi, 0.02);
  EXPECT_EQ(mesh.vertices.size(), 2000U);
}

/// The corners of two cubes of 1 m and points within them, labels 4 and 7.
Cloud cubes() {
  Random random(1);
  Cloud cloud;
  for (const int label : {4, 7})
    for (int i = 0; i < 50; ++i) {
      const Vector3d p = i < 8 ? Vector3d(i & 1, i >> 1 & 1, i >> 2)
                               : Vector3d(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9), random.uniform(0.1, 0.9));
      cloud.points.emplace_back((p + Vector3d(label == 4 ? 0 : 5, 0, 0)).cast<float>());
      cloud.labels.push_back(label);
    }
  return cloud;
}

TEST(PclConvexHull, EachLabelHasItsOwn) {
  EXPECT_NEAR(area_of(mesh_of<ConvexHull>(cubes())), 2 * (6 + 6 + 1), 1e-4);
  const Mesh two = mesh_of<ConvexHull>(cubes(), {true});
  EXPECT_NEAR(area_of(two), 12, 1e-4);
  EXPECT_EQ(two.vertices.size(), 16U);
  Cloud without = cubes();
  without.labels.clear();
  EXPECT_THROW(mesh_of<ConvexHull>(without, {true}), Error);
}

TEST(PclConvexHull, FlatCloudsHaveNone) {
  Cloud cloud = cubes();
  for (auto& p : cloud.points) p.z() = 1;
  EXPECT_TRUE(mesh_of<ConvexHull>(cloud).triangles.empty());
}

template <class Node>
class PclSurface : public testing::Test {};
using Nodes = testing::Types<Poisson, Greedy, MarchingCubes, ConvexHull>;
TYPED_TEST_SUITE(PclSurface, Nodes);

TYPED_TEST(PclSurface, FewPointsHaveNone) {
  for (const int count : {0, 1, 9}) {
    const Mesh mesh = mesh_of<TypeParam>(sphere(count));
    EXPECT_TRUE(mesh.triangles.empty());
    EXPECT_EQ(mesh.origin, Vector3d(500000, 5400000, 0));
  }
}

TYPED_TEST(PclSurface, PointsInOnePlaceLineOrPlaneDoNoHarm) {
  for (int dimensions = 0; dimensions < 3; ++dimensions) {
    Cloud cloud;
    for (int row = 0; row < 10; ++row)
      for (int column = 0; column < 100; ++column) {
        const auto x = 0.01F * static_cast<float>(column), y = 0.01F * static_cast<float>(row);
        cloud.points.emplace_back(dimensions > 0 ? x : 0, dimensions > 1 ? y : 0, 0);
        cloud.normals.emplace_back(Eigen::Vector3f::UnitZ());
      }
    const Mesh mesh = mesh_of<TypeParam>(cloud);
    EXPECT_TRUE(dimensions > 0 || mesh.triangles.empty());
    for (const auto& v : mesh.vertices) EXPECT_TRUE(v.allFinite());
  }
}

TYPED_TEST(PclSurface, GivesTheSameBytesAgain) {
  const Cloud cloud = sphere(2000, true);
  EXPECT_EQ(content_hash(mesh_of<TypeParam>(cloud)), content_hash(mesh_of<TypeParam>(cloud)));
}

template <class Node>
class PclSurfaceOfNormals : public testing::Test {};
using NormalNodes = testing::Types<Poisson, Greedy, MarchingCubes>;
TYPED_TEST_SUITE(PclSurfaceOfNormals, NormalNodes);

TYPED_TEST(PclSurfaceOfNormals, NeedsThem) {
  Cloud cloud = sphere(100);
  cloud.normals.clear();
  EXPECT_THROW(mesh_of<TypeParam>(cloud), Error);
}

}  // namespace
}  // namespace atrium::pcl_nodes::surfaces_test
