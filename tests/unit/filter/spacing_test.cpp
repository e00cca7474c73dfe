#include "modules/filter/spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "graph/api/random.hpp"

namespace atrium::filter::spacing_test {
namespace {

std::vector<double> by_brute_force(const std::vector<Eigen::Vector3f>& points, std::size_t k) {
  std::vector<double> means;
  std::vector<double> distances(points.size());
  for (const auto& p : points) {
    for (std::size_t j = 0; j < points.size(); ++j) distances[j] = (p - points[j]).cast<double>().norm();
    std::sort(distances.begin(), distances.end());
    means.push_back(0);
    for (std::size_t j = 1; j <= k; ++j) means.back() += distances[j] / static_cast<double>(k);
  }
  return means;
}

void expect_right(const std::vector<Eigen::Vector3f>& points, std::size_t k) {
  const Spacing spacing(points, k, Context());
  std::vector<double> means = by_brute_force(points, k);
  std::vector<double> limits = means;
  std::sort(limits.begin(), limits.end());
  std::vector<float> found = spacing.sample(points.size(), Context());
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), points.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i], limits[i], 1e-6 * limits[i]) << "k " << k;
  for (const std::size_t rank : {points.size() / 100, points.size() / 2, points.size() * 98 / 100, points.size() - 1}) {
    const double limit = limits[rank] * (1 + 1e-4);
    const auto marks = spacing.at_most(limit, Context());
    ASSERT_EQ(marks.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::abs(means[i] - limit) <= 1e-6 * limit) continue;
      ASSERT_EQ(marks[i], means[i] < limit ? 1 : 0) << "point " << i << " of " << points.size() << ", k " << k;
    }
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

TEST(Spacing, ASampleIsLikeTheWhole) {
  Random random(10);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 40000; ++i) {  // half of it four times as dense
    const double width = i % 5 == 0 ? 4 : 2;
    points.push_back(Eigen::Vector3d(random.uniform(0, width), random.uniform(0, 4), i % 5 == 0 ? 5 : 0).cast<float>());
  }
  const Spacing spacing(points, 16, Context());
  const auto mean = [](const std::vector<float>& values) {
    double sum = 0;
    for (const float v : values) sum += static_cast<double>(v);
    return sum / static_cast<double>(values.size());
  };
  const auto all = spacing.sample(points.size(), Context()), some = spacing.sample(2000, Context());
  EXPECT_EQ(all.size(), points.size());
  EXPECT_GE(some.size(), 2000U);
  EXPECT_LE(some.size(), 2016U);
  EXPECT_NEAR(mean(some) / mean(all), 1, 0.03);
}

}  // namespace
}  // namespace atrium::filter::spacing_test
