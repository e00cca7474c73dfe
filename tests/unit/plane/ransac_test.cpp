#include "modules/plane/ransac.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>

#include "tests/support/flat_cloud.hpp"

namespace atrium::plane::ransac_test {
namespace {

using test::box_faces;
using test::Face;
using test::furnished_flat;
using test::match_faces;
using test::sample;
using test::Sampling;

PlanePrimitives find(Cloud cloud, const Ransac::Params& params = {}, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  return Ransac::run({input(std::move(cloud))}, params, context).planes;
}

/// A square patch of points on a lattice, side `size`, seen from the side of the normal.
void add_patch(Cloud& cloud, const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v, int n) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      cloud.points.emplace_back(corner + u * (static_cast<float>(i) / static_cast<float>(n)) +
                                v * (static_cast<float>(j) / static_cast<float>(n)));
      cloud.normals.push_back(u.cross(v).normalized());
    }
}

void expect_sound(const PlanePrimitives& planes) {
  std::vector<bool> taken(planes.cloud->size(), false);
  std::size_t before = planes.cloud->size();
  for (const PlanePrimitive& p : planes.primitives) {
    EXPECT_LE(p.inliers.size(), before);
    before = p.inliers.size();
    EXPECT_NEAR(p.plane.normal.norm(), 1, 1e-12);
    for (std::size_t i = 0; i < p.inliers.size(); ++i) {
      EXPECT_TRUE(i == 0 || p.inliers[i - 1] < p.inliers[i]);
      EXPECT_FALSE(taken[p.inliers[i]]);
      taken[p.inliers[i]] = true;
    }
  }
}

TEST(PlaneRansac, FindsTheSixPlanesOfABoxExactly) {
  const auto faces = box_faces({-2, -1.5, 0}, {2, 1.5, 2.5}, true);
  Sampling sampling;
  sampling.points = 60000;
  const PlanePrimitives planes = find(sample(faces, sampling));
  expect_sound(planes);
  ASSERT_EQ(planes.primitives.size(), 6U);
  for (const auto& match : match_faces(faces, planes)) {
    EXPECT_GT(match.best_iou, 0.9);
    EXPECT_LT(match.angle, 0.05);     // degrees; the normal's sign included
    EXPECT_LT(match.offset, 0.0005);  // metres, at 8 mm noise
  }
}

TEST(PlaneRansac, KeepsTheSidesOfAThinWallApart) {
  const std::vector<Face> faces{{{0, 0.12, 0}, {0, 0, 2.5}, {4, 0, 0}, {}, true},
                                {{0, 0, 0}, {4, 0, 0}, {0, 0, 2.5}, {}, true}};
  Sampling sampling;
  sampling.points = 20000;
  const PlanePrimitives planes = find(sample(faces, sampling));
  ASSERT_EQ(planes.primitives.size(), 2U);
  EXPECT_LT(planes.primitives[0].plane.normal.dot(planes.primitives[1].plane.normal), -0.999);
  for (const auto& match : match_faces(faces, planes)) EXPECT_GT(match.best_iou, 0.9);
}

TEST(PlaneRansac, SeparatesCoplanarSurfacesThatFaceOppositeWays) {
  Cloud cloud;
  add_patch(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 60);
  add_patch(cloud, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, 60);
  const PlanePrimitives planes = find(cloud);
  ASSERT_EQ(planes.primitives.size(), 2U);
  EXPECT_EQ(planes.primitives[0].inliers.size(), 3600U);
  EXPECT_EQ(planes.primitives[1].inliers.size(), 3600U);
}

TEST(PlaneRansac, SeparatesCoplanarPatchesBeyondTheClusterDistance) {
  Cloud cloud;
  add_patch(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 60);
  add_patch(cloud, {1.1F, 0, 0}, {1, 0, 0}, {0, 1, 0}, 60);
  EXPECT_EQ(find(cloud, {.cluster_distance = 0.05}).primitives.size(), 2U);
  EXPECT_EQ(find(cloud, {.cluster_distance = 0.15}).primitives.size(), 1U);
  EXPECT_EQ(find(cloud).primitives.size(), 2U);
}

TEST(PlaneRansac, FindsEveryStructuralPlaneOfAFurnishedFlat) {
  const auto faces = furnished_flat();
  const PlanePrimitives planes = find(sample(faces, {.points = 200000}));
  expect_sound(planes);
  for (const auto& match : match_faces(faces, planes)) {
    if (!faces[match.face].structural || faces[match.face].area() < 0.5) continue;
    EXPECT_GT(match.best_iou, 0.9) << "face " << match.face;
    EXPECT_LT(match.angle, 0.1);
    EXPECT_LT(match.offset, 0.001);
  }
}

TEST(PlaneRansac, TakesTheLargestPlanesFirst) {
  const auto faces = box_faces({0, 0, 0}, {5, 4, 2.5}, true);
  const PlanePrimitives planes = find(sample(faces, {.points = 30000}), {.max_planes = 2});
  ASSERT_EQ(planes.primitives.size(), 2U);
  for (const auto& p : planes.primitives) EXPECT_GT(std::abs(p.plane.normal.z()), 0.99);
}

TEST(PlaneRansac, SameBytesWithAnyNumberOfThreads) {
  const Cloud cloud = sample(furnished_flat(), {.points = 40000});
  const std::string expected = content_hash(find(cloud));
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(content_hash(find(cloud)), expected) << threads;
  }
}

TEST(PlaneRansac, AnotherSeedFindsTheSamePlanes) {
  const auto faces = box_faces({0, 0, 0}, {5, 4, 2.5}, true);
  const Cloud cloud = sample(faces, {.points = 30000});
  for (const std::uint64_t seed : {1, 2, 3}) {
    const PlanePrimitives planes = find(cloud, {}, seed);
    EXPECT_GE(planes.primitives.size(), 6U);
    for (const auto& match : match_faces(faces, planes)) EXPECT_GT(match.best_iou, 0.9);
  }
}

TEST(PlaneRansac, FindsNothingInNoise) {
  Sampling sampling;
  sampling.points = 20000;
  sampling.outliers = 1;
  EXPECT_TRUE(find(sample(box_faces({0, 0, 0}, {5, 4, 2.5}, true), sampling)).primitives.empty());
}

TEST(PlaneRansac, EndsInALargeCloudOfSparseNoise) {
  Sampling sampling;
  sampling.points = 60000;
  sampling.outliers = 1;
  Cloud cloud = sample(box_faces({0, 0, 0}, {5, 4, 2.5}, true), sampling);
  EXPECT_TRUE(find(cloud).primitives.empty());
  for (auto& p : cloud.points) p *= 1000;  // millimetres taken for metres
  EXPECT_TRUE(find(cloud).primitives.empty());
}

TEST(PlaneRansac, FindsNothingAlongALine) {
  Cloud cloud;
  for (int i = 0; i < 1000; ++i) {
    cloud.points.emplace_back(static_cast<float>(i) * 0.01F, 0.0F, 0.0F);
    cloud.normals.emplace_back(0.0F, 0.0F, 1.0F);
  }
  EXPECT_TRUE(find(cloud).primitives.empty());
}

TEST(PlaneRansac, TakesDuplicatesAsTheyAre) {
  Cloud cloud;
  add_patch(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 40);
  for (int i = 0; i < 5000; ++i) {
    cloud.points.push_back(cloud.points[7]);
    cloud.normals.push_back(cloud.normals[7]);
  }
  const PlanePrimitives planes = find(cloud);
  ASSERT_EQ(planes.primitives.size(), 1U);
  EXPECT_EQ(planes.primitives[0].inliers.size(), cloud.size());

  Cloud one;
  one.points.assign(5000, {1, 2, 3});
  one.normals.assign(5000, {0, 0, 1});
  EXPECT_TRUE(find(one).primitives.empty());
}

TEST(PlaneRansac, AFarOutlierChangesNothing) {
  Cloud cloud;
  add_patch(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 60);
  add_patch(cloud, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 60);
  cloud.points.emplace_back(1e9F, 1e9F, 0.0F);
  cloud.normals.emplace_back(0.0F, 0.0F, 1.0F);
  cloud.points.emplace_back(-1e30F, 0.0F, 0.0F);
  cloud.normals.emplace_back(0.0F, 0.0F, 1.0F);
  const PlanePrimitives planes = find(cloud);
  ASSERT_EQ(planes.primitives.size(), 2U);
  EXPECT_NEAR(planes.primitives[0].residual, 0, 1e-6);
}

TEST(PlaneRansac, SaysWhatIsMissing) {
  Cloud cloud;
  EXPECT_THROW(find(cloud), Error);
  cloud.points = {{0, 0, 0}, {1, 0, 0}};
  cloud.normals = {{0, 0, 1}, {0, 0, 1}};
  EXPECT_THROW(find(cloud), Error);
  cloud.points.emplace_back(0, 1, 0);
  cloud.normals.clear();
  try {
    find(cloud);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("normals"), std::string::npos);
    EXPECT_NE(error.help().find("normal.estimate"), std::string::npos);
  }
}

}  // namespace
}  // namespace atrium::plane::ransac_test
