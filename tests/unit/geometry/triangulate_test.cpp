#include "modules/geometry/triangulate.hpp"

#include <gtest/gtest.h>

#include <map>

namespace atrium::triangulate_test {
namespace {

using Ring = std::vector<Eigen::Vector2d>;

double area(const PlaneTriangles& pieces) {
  double sum = 0;
  for (const auto& [a, b, c] : pieces.triangles) {
    const Eigen::Vector2d u = pieces.points[b] - pieces.points[a], v = pieces.points[c] - pieces.points[a];
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, 0);
    sum += twice / 2;
  }
  return sum;
}
/// Every edge has one triangle on each side; the sum of the one-sided ones is the border.
double border(const PlaneTriangles& pieces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : pieces.triangles)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(++edges[std::pair(t[k], t[(k + 1) % 3])], 1);
  double length = 0;
  for (const auto& [edge, count] : edges)
    if (edges.count({edge.second, edge.first}) == 0)
      length += (pieces.points[edge.first] - pieces.points[edge.second]).norm();
  return length;
}

TEST(Triangulate, ConvexConcaveHolesAndSlants) {
  const Ring square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  EXPECT_EQ(triangulate({square}).triangles.size(), 2U);
  const Ring hole{{1, 1}, {1, 2}, {2, 2}, {2, 1}}, other{{2.5, 1}, {3.5, 1}, {3.5, 3.5}, {2.5, 3.5}};
  const auto holed = triangulate({square, hole, other});
  EXPECT_NEAR(area(holed), 16 - 1 - 2.5, 1e-12);
  EXPECT_NEAR(border(holed), 16 + 4 + 7, 1e-12);
  const Ring l{{0, 0}, {5, 0}, {5, 2}, {2, 2}, {2, 4}, {0, 4}};
  EXPECT_NEAR(area(triangulate({l})), 14, 1e-12);
  EXPECT_NEAR(border(triangulate({l})), 18, 1e-12);
  const Ring gable{{0, 0}, {6, 0}, {6, 1}, {3, 4}, {0, 1}}, tilted{{3, 1}, {4, 2}, {3, 3}, {2, 2}};
  EXPECT_NEAR(area(triangulate({gable, tilted})), 6 + 9 - 2, 1e-12);
  EXPECT_NEAR(border(triangulate({gable, tilted})), 8 + 6 * std::sqrt(2) + 4 * std::sqrt(2), 1e-12);
  EXPECT_TRUE(triangulate({}).triangles.empty());
}

TEST(Triangulate, RingsThatCrossAreNoError) {
  // From a fuzzer: a corner was looked up on the wrong side of another one.
  const Ring outline{{1, 0}, {2, 0}, {2, 2}, {0, 2}}, hole{{0.5, 0.5}, {0.5, 1}, {1, 1}, {0, 0.5}};
  const auto pieces = triangulate({outline, hole});
  EXPECT_FALSE(pieces.triangles.empty());
  for (const auto& t : pieces.triangles)
    for (const auto v : t) EXPECT_LT(v, pieces.points.size());
}

}  // namespace
}  // namespace atrium::triangulate_test
