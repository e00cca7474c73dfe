#include "modules/geometry/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "graph/api/random.hpp"
#include "modules/geometry/linear_solve.hpp"

namespace atrium::triangle_tree_test {
namespace {

struct Soup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Eigen::Vector3d point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}
/// Random triangles of mixed sizes; some without area, some twice, about `centre`.
Soup soup(std::size_t count, std::uint64_t seed, const Eigen::Vector3d& centre) {
  Random random(seed);
  Soup s;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d a = centre + point(random, 5);
    const double size = random.uniform() < 0.1 ? 4 : 0.3;
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    Eigen::Vector3d b = a + point(random, size), c = a + point(random, size);
    if (i % 17 == 3) c = a + 0.3 * (b - a);
    if (i % 29 == 5) b = c = a;
    s.vertices.insert(s.vertices.end(), {a, b, c});
    s.triangles.push_back({first, first + 1, first + 2});
    if (i % 13 == 4) s.triangles.push_back({first, first + 1, first + 2});
  }
  return s;
}
/// Another way to the distance: the foot on the plane if inside, else the nearest of the sides.
double squared_distance(const Soup& s, std::size_t t, const Eigen::Vector3d& p) {
  std::array<Eigen::Vector3d, 3> v;
  for (int k = 0; k < 3; ++k) v[k] = s.vertices[s.triangles[t][k]];
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d a = v[k], ab = v[(k + 1) % 3] - a;
    const double along = ab.squaredNorm() > 0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
    best = std::min(best, (p - a - along * ab).squaredNorm());
  }
  const Eigen::Vector3d n = (v[1] - v[0]).cross(v[2] - v[0]);
  if (n.norm() < 1e-12) return best;
  bool in = true;
  for (int k = 0; k < 3; ++k) in = in && (v[(k + 1) % 3] - v[k]).cross(p - v[k]).dot(n) >= 0;
  return in ? std::pow((p - v[0]).dot(n.normalized()), 2) : best;
}

class TriangleTreeSoup : public testing::TestWithParam<std::tuple<std::size_t, double>> {
 protected:
  std::size_t count = std::get<0>(GetParam());
  Eigen::Vector3d centre = Eigen::Vector3d::Constant(std::get<1>(GetParam()));
  Soup s = soup(count, count, centre);
  TriangleTree tree{s.vertices, s.triangles};
  Random random{99};
};

TEST_P(TriangleTreeSoup, NearestIsThatOfBruteForce) {
  std::uint32_t hint = TriangleTree::none;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = centre + point(random, i % 10 == 0 ? 100 : 7);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < s.triangles.size(); ++t) best = std::min(best, squared_distance(s, t, p));
    const auto found = tree.nearest(p);
    ASSERT_TRUE(found);
    ASSERT_NEAR(std::sqrt(found.squared_distance), std::sqrt(best), 1e-9);
    ASSERT_NEAR(std::sqrt(squared_distance(s, found.triangle, p)), std::sqrt(best), 1e-9);
    // A hint changes nothing, nor does a limit above the answer; one below finds nothing.
    EXPECT_EQ(tree.nearest(p, std::numeric_limits<double>::infinity(), hint).squared_distance, found.squared_distance);
    EXPECT_EQ(tree.nearest(p, found.squared_distance * 1.001).squared_distance, found.squared_distance);
    EXPECT_FALSE(tree.nearest(p, found.squared_distance * 0.999));
    hint = found.triangle;
  }
}

TEST_P(TriangleTreeSoup, FiltersAndRangesAreThoseOfBruteForce) {
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = centre + point(random, 6);
    double best = std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> expected, found;
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      const double d = squared_distance(s, t, p);
      if (t % 3 == 1) best = std::min(best, d);
      if (d <= 1) expected.push_back(static_cast<std::uint32_t>(t));
    }
    const auto third =
        tree.nearest_of(p, std::numeric_limits<double>::infinity(), [](std::uint32_t t) { return t % 3 == 1; });
    if (s.triangles.size() > 1) {
      EXPECT_NEAR(third.squared_distance, best, 1e-9 * (1 + best));
    } else {
      EXPECT_FALSE(third);
    }
    tree.within(p, 1, found);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST_P(TriangleTreeSoup, RaysHitWhatBruteForceHits) {
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d from = centre + point(random, 8);
    Eigen::Vector3d direction = point(random, 1).normalized();
    if (i % 5 == 0) direction = Eigen::Vector3d::Unit(i % 3) * (i % 2 == 0 ? 1 : -1);
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : s.triangles) {
      const Eigen::Vector3d ab = s.vertices[b] - s.vertices[a], ac = s.vertices[c] - s.vertices[a];
      if (ab.cross(ac).norm() < 1e-9) continue;
      Eigen::Matrix3d m;
      m << ab, ac, -direction;
      const Eigen::Vector3d x = linear_solve(m, from - s.vertices[a]);
      if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] > 0) best = std::min(best, x[2]);
    }
    const auto hit = tree.cast(from, direction);
    ASSERT_EQ(static_cast<bool>(hit), std::isfinite(best));
    EXPECT_EQ(tree.blocked(from, direction, 1e9), std::isfinite(best));
    if (!hit) continue;
    ++hits;
    ASSERT_NEAR(hit.distance, best, 1e-8);
    EXPECT_FALSE(tree.cast(from, direction, hit.distance * 0.999));
    EXPECT_FALSE(tree.blocked(from, direction, hit.distance * 0.999));
    EXPECT_TRUE(tree.blocked(from, direction, hit.distance * 1.001));
    const auto& [a, b, c] = s.triangles[hit.triangle];
    const Eigen::Vector3d n = (s.vertices[b] - s.vertices[a]).cross(s.vertices[c] - s.vertices[a]);
    EXPECT_EQ(hit.front, n.dot(direction) < 0);
  }
  if (count > 100) {
    EXPECT_GT(hits, 50);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TriangleTreeSoup,
                         testing::Combine(testing::Values(1, 5, 200, 3000), testing::Values(0.0, 1000.0)));

TEST(TriangleTree, EmptyFindsNothing) {
  const TriangleTree tree;
  EXPECT_TRUE(tree.empty());
  EXPECT_FALSE(tree.nearest({0, 0, 0}));
  EXPECT_FALSE(tree.cast({0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(tree.blocked({0, 0, 0}, {1, 0, 0}, 10));
}

TEST(TriangleTree, ManyTrianglesInOnePlaceStillBuild) {
  std::vector<Eigen::Vector3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> triangles(50000, {0, 1, 2});
  const TriangleTree tree(vertices, triangles);
  EXPECT_NEAR(tree.nearest({0.2, 0.2, 2}).squared_distance, 4, 1e-12);
  const auto hit = tree.cast({0.2, 0.2, 2}, {0, 0, -1});
  EXPECT_EQ(hit.triangle, 0U);  // ties: the least index
  EXPECT_TRUE(hit.front);
}

TEST(TriangleTree, SeamsLetNoRayThrough) {
  // A square of four triangles about its middle; rays through the seams.
  const std::vector<Eigen::Vector3d> v{{0, 0, 0}, {3, 0, 0.1}, {3, 3, 0}, {0, 3, 0.1}, {1.1, 1.7, 0.05}};
  const TriangleTree tree(v, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d on_seam = v[4] + random.uniform() * 0.99 * (v[i % 4] - v[4]);
    const Eigen::Vector3d from(random.uniform(0.5, 2.5), random.uniform(0.5, 2.5), 2);
    ASSERT_TRUE(tree.cast(from, on_seam - from));
  }
}

}  // namespace
}  // namespace atrium::triangle_tree_test
