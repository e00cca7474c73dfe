#include "modules/baseline/ksr.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>

#include "graph/api/error.hpp"
#include "modules/baseline/helper_program.hpp"
#include "tests/support/flat_cloud.hpp"
#include "tests/unit/baseline/closed_surface.hpp"

namespace atrium::baseline::ksr_test {
namespace {

bool have_helper() { return std::filesystem::exists(helper_file("atrium-ksr")); }
#define NEEDS_KSR() \
  if (!have_helper()) GTEST_SKIP() << "atrium-ksr is not built: needs -DATRIUM_CGAL=ON and CGAL 6.0"

Cloud cloud_of(const std::vector<test::Face>& faces, std::size_t points) {
  test::Sampling sampling;
  sampling.points = points;
  sampling.noise = 0.002;
  sampling.outliers = 0;
  sampling.normal_error = 2;
  Cloud cloud = test::sample(faces, sampling);
  cloud.origin = {500000, 200000, 30};
  return cloud;
}

std::string problem(const Cloud& cloud, const Ksr::Params& params = {}) {
  Context context;
  try {
    Ksr::run({input(cloud)}, params, context);
  } catch (const Error& error) {
    return std::string(error.what()) + " / " + error.help();
  }
  return "none";
}

TEST(Ksr, ARoomHasTwelveTriangles) {
  NEEDS_KSR();
  Context context;
  const Cloud cloud = cloud_of(test::box_faces({1, 2, 0}, {5, 5, 2.5}, true), 8000);
  const auto out = Ksr::run({input(cloud)}, {}, context);
  EXPECT_EQ(out.mesh.origin, cloud.origin);
  EXPECT_EQ(out.mesh.triangles.size(), 12U);
  EXPECT_TRUE(is_closed(out.mesh));
  EXPECT_NEAR(volume(out.mesh), -4 * 3 * 2.5, 0.1);
}

TEST(Ksr, AnObjectLooksOutward) {
  NEEDS_KSR();
  Context context;
  Ksr::Params params;
  params.indoors = false;
  const Cloud cloud = cloud_of(test::box_faces({0, 0, 0}, {2, 1, 1}, false), 6000);
  const auto out = Ksr::run({input(cloud)}, params, context);
  EXPECT_EQ(out.mesh.triangles.size(), 12U);
  EXPECT_TRUE(is_closed(out.mesh));
  EXPECT_NEAR(volume(out.mesh), 2, 0.05);
}

TEST(Ksr, SaysThatThereIsNoPlane) {
  NEEDS_KSR();
  Ksr::Params params;
  params.min_points = 100000;
  EXPECT_NE(problem(cloud_of(test::box_faces({0, 0, 0}, {2, 1, 1}, true), 2000), params).find("no plane was found"),
            std::string::npos);
}

TEST(Ksr, RefusesWhatHasNoPlanes) {
  EXPECT_NE(problem({}).find("at least 3 points, the cloud has 0"), std::string::npos);
  Cloud bare = cloud_of(test::box_faces({0, 0, 0}, {2, 1, 1}, true), 100);
  bare.normals.clear();
  EXPECT_NE(problem(bare).find("has no normals"), std::string::npos);
}

TEST(Ksr, SaysHowToGetTheHelper) {
  if (have_helper()) GTEST_SKIP() << "atrium-ksr is built";
  const std::string text = problem(cloud_of(test::box_faces({0, 0, 0}, {2, 1, 1}, true), 100));
  EXPECT_NE(text.find("this build has no atrium-ksr"), std::string::npos);
  EXPECT_NE(text.find("CGAL 6.0"), std::string::npos);
  EXPECT_NE(text.find("GNU GPL"), std::string::npos);
}

}  // namespace
}  // namespace atrium::baseline::ksr_test
