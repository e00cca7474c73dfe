#include "modules/filter/spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "graph/api/random.hpp"

namespace atrium::filter {
namespace {

void expect_right(const std::vector<Eigen::Vector3f>& points, std::size_t k) {
  const std::vector<float> found = mean_distances(points, k, Context());
  ASSERT_EQ(found.size(), points.size());
  std::vector<double> distances(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) distances[j] = (points[i] - points[j]).cast<double>().norm();
    std::sort(distances.begin(), distances.end());
    double mean = 0;
    for (std::size_t j = 1; j <= k; ++j) mean += distances[j] / static_cast<double>(k);
    ASSERT_NEAR(found[i], mean, 1e-6 * mean) << "point " << i << " of " << points.size() << ", k " << k;
  }
}

TEST(Spacing, IsTheMeanDistanceToTheNearest) {
  Random random(8);
  std::vector<Eigen::Vector3f> points(1500);
  for (auto& p : points)
    p = Eigen::Vector3d(random.uniform(0, 5), random.uniform(0, 4), random.uniform(0, 0.01)).cast<float>();
  for (const std::size_t k : {1, 2, 16, 100, 1499}) expect_right(points, k);
}

TEST(Spacing, AnyDensity) {
  Random random(9);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1500; ++i) {
    const double width = std::pow(10.0, random.uniform(-6, 4));  // from micrometres to kilometres
    points.push_back(
        Eigen::Vector3d(random.uniform(0, width), random.uniform(0, width), random.uniform(0, width)).cast<float>());
  }
  points.insert(points.end(), 300, Eigen::Vector3f(1, 2, 3));  // in one place
  points.emplace_back(1e6F, -1e6F, 1e6F);
  for (const std::size_t k : {1, 16, 400}) expect_right(points, k);
}

TEST(Spacing, FewPoints) {
  expect_right({{0, 0, 0}, {1, 0, 0}}, 1);
  expect_right({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 0, 0}, {1, 1, 1}, {5, 0, 0}, {0, 6, 0}, {0, 0, 7}, {8, 8, 8}}, 8);
}

}  // namespace
}  // namespace atrium::filter
