#include "modules/geometry/point_tree.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "graph/api/random.hpp"

namespace atrium::point_tree_test {
namespace {

/// What a search must find, by looking at every point.
std::vector<Neighbour> brute_force(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& p, float reach) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f d = points[i] - p;
    const float d2 = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    if (d2 <= reach * reach) all.push_back({i, d2});
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// One search for a box around the position holds all that the position finds.
void expect_right_squares(const PointTree& tree, const Eigen::Vector3f& q, float reach,
                          const std::vector<Neighbour>& expected) {
  std::vector<std::uint32_t> nodes, some;
  const Eigen::AlignedBox3f around(q - Eigen::Vector3f::Ones(), q + Eigen::Vector3f::Constant(0.5F));
  ASSERT_TRUE(tree.nodes_near(around, reach, tree.size(), nodes));
  ASSERT_TRUE(nodes.empty() || !tree.nodes_near(around, reach, nodes.size() - 1, some));
  std::vector<float> squares;
  tree.squared_distances(q, reach, nodes, squares);
  std::sort(squares.begin(), squares.end());
  ASSERT_TRUE(std::equal(squares.begin(), squares.end(), expected.begin(), expected.end(),
                         [](float square, const Neighbour& n) { return square == n.squared_distance; }));
}

void expect_right(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& queries,
                  float reach) {
  const PointTree tree(points, Context());
  std::vector<Neighbour> found;
  for (const auto& q : queries) {
    const auto expected = brute_force(points, q, reach);
    tree.within(q, reach, found);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
    for (const std::size_t k : {1, 5, 40}) {
      tree.k_nearest(q, k, found, reach);
      ASSERT_EQ(found, std::vector<Neighbour>(expected.begin(), expected.begin() + std::min(k, expected.size())));
    }
    expect_right_squares(tree, q, reach, expected);
    for (const std::size_t near : {std::size_t{0}, points.size() / 2 / PointTree::fan, points.size()})
      for (const std::size_t count : {expected.size() / 2, expected.size(), expected.size() + 1})
        ASSERT_EQ(tree.has_within(q, reach, count, near), count <= expected.size()) << count;
    Neighbour nearest{};
    ASSERT_EQ(tree.nearest(q, nearest, reach), !expected.empty());
    if (!expected.empty()) {
      ASSERT_EQ(nearest, expected.front());
    }
  }
}

std::vector<Eigen::Vector3f> cube(std::size_t count, double width, Random& random) {
  std::vector<Eigen::Vector3f> points(count);
  for (auto& p : points)
    p = Eigen::Vector3d(random.uniform(0, width), random.uniform(0, width), random.uniform(0, width)).cast<float>();
  return points;
}

TEST(PointTree, FindsWhatBruteForceFinds) {
  Random random(3);
  const auto points = cube(4000, 2, random);
  auto queries = cube(60, 3, random);
  queries.insert(queries.end(), points.begin(), points.begin() + 40);
  expect_right(points, queries, 0.4F);
  expect_right(points, queries, PointTree::everywhere);
  expect_right(points, queries, 0.0F);
}

TEST(PointTree, EqualDistancesGoByIndex) {
  std::vector<Eigen::Vector3f> points;  // a lattice: many points equally far
  for (int i = 0; i < 1000; ++i)
    points.emplace_back(static_cast<float>(i % 10), static_cast<float>(i / 10 % 10), static_cast<float>(i / 100));
  std::vector<Eigen::Vector3f> queries(points.begin(), points.begin() + 50);
  queries.emplace_back(4.5F, 4.5F, 4.5F);
  queries.emplace_back(0.5F, 4.0F, 4.5F);
  expect_right(points, queries, 3);
}

TEST(PointTree, ClustersDuplicatesAndWildPoints) {
  Random random(9);
  auto points = cube(3000, 1e-4, random);
  points.insert(points.end(), 5000, Eigen::Vector3f(1, 2, 3));
  points.emplace_back(1e6F, 1e6F, -1e6F);
  const std::vector<Eigen::Vector3f> queries{{0, 0, 0}, {5e-5F, 5e-5F, 5e-5F}, {1, 2, 3}, {1, 2, 2}, {1e6F, 0, 0}};
  expect_right(points, queries, 2);
  expect_right(points, queries, PointTree::everywhere);
  // Searching every duplicate must not look at every other one.
  const PointTree duplicates(std::vector<Eigen::Vector3f>(300000, {1, 2, 3}), Context());
  std::vector<Neighbour> found;
  for (int i = 0; i < 300000; ++i) duplicates.k_nearest({1, 2, 3}, 3, found);
  EXPECT_EQ(found, (std::vector<Neighbour>{{0, 0}, {1, 0}, {2, 0}}));
}

TEST(PointTree, NoPointAndOnePoint) {
  Neighbour n{};
  EXPECT_FALSE(PointTree().nearest({0, 0, 0}, n));
  EXPECT_FALSE(PointTree({}, Context()).nearest({0, 0, 0}, n));
  expect_right({{1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}, 1);
  expect_right({{1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}, PointTree::everywhere);
}

TEST(PointTree, TheOrderDoesNotDependOnThreads) {
  Random random(4);
  const auto points = cube(200000, 5, random);
  std::vector<std::uint32_t> one;
  tbb::task_arena(1).execute([&] { one = PointTree(points, Context()).order(); });
  for (const int threads : {2, 4})
    tbb::task_arena(threads).execute([&] { EXPECT_EQ(PointTree(points, Context()).order(), one); });
}

}  // namespace
}  // namespace atrium::point_tree_test
