#include "modules/geometry/poisson_disk.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "graph/api/error.hpp"
#include "graph/api/value.hpp"
#include "modules/geometry/point_tree.hpp"

namespace atrium::poisson_disk_test {
namespace {

/// A rectangle 4 m × 2 m at z = 1 in unequal triangles, one of them without area, with the origin far off.
Mesh plate() {
  Mesh mesh;
  mesh.origin = {500000, 5400000, 0};
  mesh.vertices = {{0, 0, 1}, {4, 0, 1}, {4, 2, 1}, {0, 2, 1}, {0.2, 0, 1}};
  mesh.colours = {{0, 0, 0}, {200, 0, 0}, {200, 100, 0}, {0, 100, 0}, {10, 0, 0}};
  mesh.triangles = {{0, 4, 3}, {0, 0, 1}, {4, 1, 2}, {4, 2, 3}, {0, 4, 1}};
  return mesh;
}

TEST(PoissonDisk, GivesExactlyTheCountAndKeepsEverySampleApart) {
  for (const std::size_t count : {1, 2, 10, 1000, 20000}) {
    const Cloud cloud = sample_poisson_disk(plate(), count, Context());
    ASSERT_EQ(cloud.size(), count);
    if (count < 1000) continue;
    const PointTree tree(cloud.points, Context());
    const double r_max = std::sqrt(8 / (2 * std::numbers::sqrt3 * static_cast<double>(count)));
    double least = 1;
    std::vector<Neighbour> found;
    for (const auto& p : cloud.points) {
      tree.k_nearest(p, 2, found);
      least = std::min(least, std::sqrt(static_cast<double>(found[1].squared_distance)) / (2 * r_max));
    }
    EXPECT_GT(least, 0.5) << count;  // uniform samples: below 0.01
  }
}

TEST(PoissonDisk, PointsLieOnFacesWithTheirNormalsAndColours) {
  const Cloud cloud = sample_poisson_disk(plate(), 5000, Context());
  EXPECT_EQ(cloud.origin, plate().origin);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto& p = cloud.points[i];
    EXPECT_NEAR(p.z(), 1, 1e-6);
    EXPECT_TRUE(p.x() >= 0 && p.x() <= 4 && p.y() >= 0 && p.y() <= 2);
    EXPECT_TRUE(cloud.normals[i].isApprox(Eigen::Vector3f::UnitZ()));
    EXPECT_NEAR(cloud.colours[i][0], 50 * p.x(), 1.01);
    EXPECT_NEAR(cloud.colours[i][1], 50 * p.y(), 1.01);
    mean += p.cast<double>() / 5000;
  }
  EXPECT_NEAR(mean.x(), 2, 0.01);
  EXPECT_NEAR(mean.y(), 1, 0.01);
}

TEST(PoissonDisk, TheSeedDecidesTheSamplesAndThreadsDoNot) {
  std::string one;
  tbb::task_arena(1).execute([&] { one = content_hash(sample_poisson_disk(plate(), 30000, Context())); });
  for (const int threads : {2, 4})
    tbb::task_arena(threads).execute(
        [&] { EXPECT_EQ(content_hash(sample_poisson_disk(plate(), 30000, Context())), one); });
  EXPECT_NE(content_hash(sample_poisson_disk(plate(), 30000, Context(2, std::make_shared<ContextHost>()))), one);
}

TEST(PoissonDisk, MeshesWithoutSurfaceAreErrors) {
  EXPECT_THROW(sample_poisson_disk({}, 10, Context()), Error);
  Mesh flat = plate();
  flat.triangles = {{0, 4, 1}, {0, 0, 0}};
  EXPECT_THROW(sample_poisson_disk(flat, 10, Context()), Error);
  Mesh missing = plate();
  missing.triangles.push_back({0, 1, 99});
  EXPECT_THROW(sample_poisson_disk(missing, 10, Context()), Error);
  Mesh infinite = plate();
  infinite.vertices[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(sample_poisson_disk(infinite, 10, Context()), Error);
  EXPECT_EQ(sample_poisson_disk(plate(), 0, Context()).size(), 0U);
}

}  // namespace
}  // namespace atrium::poisson_disk_test
