#include "modules/metric/distance.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <set>

#include "graph/api/random.hpp"
#include "meshes.hpp"
#include "modules/metric/mesh_samples.hpp"
#include "modules/metric/point_distance.hpp"

namespace atrium::metric::distance_test {
namespace {

using V = Eigen::Vector3d;

Metrics distance(const Cloud& cloud, const Mesh& mesh, const Distance::Params& params = {}) {
  Context context;
  return Distance::run({input(cloud), input(mesh), {}, {}}, params, context).metrics;
}
Mesh square(double size, double height) {
  Mesh m;
  add_rectangle(m, V(0, 0, height), V(size, 0, 0), V(0, size, 0), SurfaceClass::floor, 0);
  return m;
}
Cloud lattice(int n, double size, double height) {
  Cloud cloud;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) cloud.points.emplace_back(size * (i + 0.5) / n, size * (k + 0.5) / n, height);
  return cloud;
}

TEST(MetricDistance, PlanesApart) {
  // Points 3 cm above a square of 10 m: all distances are 3 cm; back, a sample's nearest point is at most half a
  // lattice diagonal aside.
  const auto m = distance(lattice(200, 10, 0.03), square(10, 0));
  for (const char* key : {"mean", "rms", "p95", "max"})
    EXPECT_NEAR(value(m, std::string("distance.cloud_to_mesh.") + key), 0.03, 1e-8);
  const double diagonal = std::sqrt(2) * (10 - 0.05);
  EXPECT_NEAR(value(m, "distance.diagonal"), diagonal, 1e-5);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.relative.rms"), 0.03 / diagonal, 1e-8);
  EXPECT_GE(value(m, "distance.mesh_to_cloud.mean"), 0.03);
  const double furthest = std::sqrt(0.03 * 0.03 + 2 * 0.025 * 0.025);
  EXPECT_LE(value(m, "distance.mesh_to_cloud.p95"), furthest);
  EXPECT_NEAR(value(m, "distance.mesh_to_cloud.max"), furthest, 1e-6);  // at the square's corners
  // Mean square over a lattice cell of 5 cm: 0.03² + 2 · 0.05² / 12.
  EXPECT_NEAR(value(m, "distance.mesh_to_cloud.rms"), std::sqrt(0.0009 + 0.0025 / 6), 5e-5);
}

TEST(MetricDistance, HalfTheSquareMissing) {
  // Points over [0,10]², mesh over x < 5 only: half the points lie on it, the others up to 5 m away.
  Mesh half;
  add_rectangle(half, V(0, 0, 0), V(5, 0, 0), V(0, 10, 0), SurfaceClass::floor, 0);
  const auto m = distance(lattice(200, 10, 0), half);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.mean"), 1.25, 1e-6);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.rms"), std::sqrt(0.5 * 25 / 3), 1e-3);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.p95"), 4.5, 0.051);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.max"), 4.975, 1e-5);
  EXPECT_LT(value(m, "distance.mesh_to_cloud.max"), 0.0354);
  // A mesh that is larger than the scan shows in the other direction.
  const auto n = distance(lattice(100, 5, 0), square(10, 0));
  EXPECT_LT(value(n, "distance.cloud_to_mesh.max"), 1e-6);
  EXPECT_NEAR(value(n, "distance.mesh_to_cloud.max"), std::sqrt(2) * 5.025, 1e-5);
}

TEST(MetricDistance, ThreeWildPointsSpoilTheRmsOnly) {
  // 40,000 points 1 cm above a square and three 100 m above it.
  Cloud cloud = lattice(200, 10, 0.01);
  for (int i = 0; i < 3; ++i) cloud.points.emplace_back(5, 5, 100);
  const auto m = distance(cloud, square(10, 0));
  const std::string name = "distance.cloud_to_mesh.";
  EXPECT_NEAR(value(m, name + "rms"), std::sqrt((40000 * 0.0001 + 3 * 10000) / 40003), 1e-6);  // 0.87 m
  for (const char* robust : {"median", "p95", "trimmed_rms", "within_rms"})
    EXPECT_NEAR(value(m, name + robust), 0.01, 1e-8) << robust;
  EXPECT_NEAR(value(m, name + "beyond"), 3.0 / 40003, 1e-12);
  EXPECT_NEAR(value(m, "distance.mesh_to_cloud.beyond"), 0, 1e-12);
  // The other way round: a mesh with 3 m² far away from everything, of 103.
  Mesh mesh = square(10, 0);
  add_rectangle(mesh, V(0, 0, 50), V(1, 0, 0), V(0, 3, 0), SurfaceClass::wall, 1);
  const auto n = distance(lattice(200, 10, 0.01), mesh);
  EXPECT_NEAR(value(n, "distance.mesh_to_cloud.beyond"), 3.0 / 103, 1e-9);
  EXPECT_LT(value(n, "distance.mesh_to_cloud.trimmed_rms"), 0.05);
  EXPECT_LT(value(n, "distance.mesh_to_cloud.within_rms"), 0.05);
  EXPECT_GT(value(n, "distance.mesh_to_cloud.rms"), 8);
}

TEST(MetricDistance, QuantilesOfAKnownSpread) {
  // Distances 1, 2, … 100 cm, once each.
  Cloud cloud;
  for (int i = 1; i <= 100; ++i) cloud.points.emplace_back(5, 5, 0.01F * static_cast<float>(i));
  Distance::Params params;
  params.limit = 0.405;
  const auto m = distance(cloud, square(10, 0), params);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.median"), 0.50, 1e-6);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.p95"), 0.95, 1e-6);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.beyond"), 0.60, 1e-12);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.trimmed_rms"), 0.01 * std::sqrt(96.0 * 191 / 6), 1e-6);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.within_rms"), 0.01 * std::sqrt(41.0 * 81 / 6), 1e-6);
  params.limit = 0.001;
  EXPECT_FALSE(has(distance(cloud, square(10, 0), params), "distance.cloud_to_mesh.within_rms"));
}

TEST(MetricDistance, StructureAndEverythingApart) {
  // The floor's points lie 1 cm above it, a table's at 0.7 m; the model has the floor, and the table 10 cm too high.
  Cloud cloud = lattice(100, 10, 0.01);
  for (const auto& p : lattice(50, 2, 0.7).points) cloud.points.push_back(p);
  const Mesh structure = square(10, 0);
  Mesh all = structure;
  add_rectangle(all, V(0, 0, 0.8), V(2, 0, 0), V(0, 2, 0), SurfaceClass::object, -1);
  Context context;
  const OptionalInput<Mesh> floor(input(structure));
  const auto m = Distance::run({input(cloud), input(all), floor, floor}, {}, context).metrics;
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.max"), 0.1, 1e-6);
  EXPECT_NEAR(value(m, "distance.structure.cloud_to_mesh.max"), 0.01, 1e-6);
  EXPECT_LT(value(m, "distance.structure.mesh_to_cloud.max"), 0.08);
  EXPECT_GT(value(m, "distance.mesh_to_cloud.max"), 0.0999);
  // Without a truth it is not known which points are the structure's.
  const auto n = Distance::run({input(cloud), input(all), floor, {}}, {}, context).metrics;
  EXPECT_FALSE(has(n, "distance.structure.cloud_to_mesh.max"));
  EXPECT_TRUE(has(n, "distance.structure.mesh_to_cloud.max"));
  EXPECT_THROW(Distance::run({input(cloud), input(all), {}, floor}, {}, context), Error);
  EXPECT_THROW(Distance::run({input(cloud), input(all), floor, OptionalInput<Mesh>(input(Mesh{}))}, {}, context),
               Error);
  EXPECT_FALSE(
      has(Distance::run({input(cloud), input(all), OptionalInput<Mesh>(input(Mesh{})), {}}, {}, context).metrics,
          "distance.structure.mesh_to_cloud.max"));
}

TEST(MetricDistance, OriginsAreTakenIntoAccount) {
  Cloud cloud = lattice(50, 10, 0.03);
  Mesh mesh = square(10, 0);
  const auto plain = distance(cloud, mesh);
  cloud.origin = {500000.25, 5400000.5, 300};
  mesh.origin = {500001.25, 5399998.5, 299};
  for (auto& v : mesh.vertices) v -= V(1, -2, -1);
  const auto far = distance(cloud, mesh);
  ASSERT_EQ(plain.values.size(), far.values.size());
  for (std::size_t i = 0; i < plain.values.size(); ++i)
    EXPECT_NEAR(plain.values[i].value, far.values[i].value, 1e-7) << plain.values[i].name;
}

TEST(MetricDistance, EveryDistanceIsThatOfASearchPerPoint) {
  // Clusters, lone points, wild outliers; a mesh of a few large and many small triangles.
  Random random(3);
  Mesh mesh = room();
  for (int i = 0; i < 2000; ++i)
    add_rectangle(mesh, V(random.uniform(1, 2), random.uniform(1, 2), random.uniform(0, 1)), V(0.03, 0, 0),
                  V(0, 0.02, 0.02), SurfaceClass::object, -1);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 20000; ++i)
    points.emplace_back(random.uniform(0, 4), random.uniform(0, 5), 0.01 * random.normal());
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(random.uniform(-3, 8), random.uniform(-3, 8), random.uniform(-3, 6));
  for (int i = 0; i < 5; ++i) points.emplace_back(1e7F * static_cast<float>(i + 1), 3e6F, -2e6F);
  Context context;
  const TriangleTree tree(mesh.vertices, mesh.triangles);
  for (const double cell : {0.02, 0.1, 0.7}) {
    const PointGrid grid(points, cell, context);
    const auto found = distances_to_mesh(grid, tree, context);
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_EQ(found[i],
                static_cast<float>(std::sqrt(tree.nearest(grid.points()[i].cast<double>()).squared_distance)));
    const CloudSearch search(grid, context);
    for (int i = 0; i < 200; ++i) {
      const V p(random.uniform(-2, 6), random.uniform(-2, 7), random.uniform(-2, i % 10 == 0 ? 500 : 4));
      double best = 1e300;
      for (const auto& q : points) best = std::min(best, (q.cast<double>() - p).norm());
      ASSERT_NEAR(search.nearest(p), best, 1e-9 * (1 + best));
    }
  }
}

TEST(MetricDistance, SameBytesWithAnyNumberOfThreads) {
  Random random(3);
  Cloud cloud;
  for (int i = 0; i < 100000; ++i)
    cloud.points.emplace_back(random.uniform(0, 4), random.uniform(0, 5), 0.1 * random.normal());
  std::set<std::string> hashes;
  for (const std::size_t threads : {1, 2, 4}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    hashes.insert(content_hash(distance(cloud, room())));
  }
  EXPECT_EQ(hashes.size(), 1U);
}

TEST(MetricDistance, DegenerateInput) {
  Cloud one;
  one.points.emplace_back(1, 1, 2);
  const auto m = distance(one, square(2, 0));
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.max"), 2, 1e-6);
  EXPECT_EQ(value(m, "distance.cloud_to_mesh.relative.max"), 0);
  EXPECT_NEAR(value(m, "distance.mesh_to_cloud.max"), std::sqrt(6), 1e-6);
  EXPECT_THROW(distance({}, square(2, 0)), Error);
  EXPECT_THROW(distance(one, {}), Error);
  EXPECT_THROW(distance(one, square(0, 0)), Error);
  Mesh bad = square(2, 0);
  bad.triangles[0][1] = 4;
  EXPECT_THROW(distance(one, bad), Error);
  bad = square(2, 0);
  bad.vertices[2].x() = std::nan("");
  EXPECT_THROW(distance(one, bad), Error);
  one.points.emplace_back(1, std::nanf(""), 2);
  EXPECT_THROW(distance(one, square(2, 0)), Error);
}

TEST(MetricDistance, HugeMeshesAreSampledWithinTheLimit) {
  Distance::Params params;
  params.max_samples = 1000;
  const auto m = distance(lattice(50, 10000, 10), square(10000, 0), params);
  EXPECT_NEAR(value(m, "distance.cloud_to_mesh.mean"), 10, 1e-3);
  EXPECT_GT(value(m, "distance.mesh_to_cloud.mean"), 10);
}

TEST(MeshSamples, StandForTheAreaEvenly) {
  const Mesh mesh = room();
  const auto samples = sample_mesh(mesh, 0.05, 1e9);
  const double area = 2 * 20 + 2 * 2.5 * 9;
  EXPECT_NEAR(samples.area, area, 1e-12);
  EXPECT_NEAR(static_cast<double>(samples.points.size()), area / 0.0025, 20);
  // The first moment of a uniform spread over the floor is its middle.
  V mean = V::Zero();
  double weight = 0;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    if (samples.triangles[i] > 1) continue;
    mean += samples.weights[i] * samples.points[i];
    weight += samples.weights[i];
  }
  EXPECT_NEAR(weight, 20, 1e-9);
  EXPECT_LT((mean / weight - V(2, 2.5, 0)).norm(), 5e-3);
}

}  // namespace
}  // namespace atrium::metric::distance_test
