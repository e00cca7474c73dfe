#include "modules/geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "graph/api/random.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/geometry/polygon_distance.hpp"

namespace atrium::polygon_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<Vector2d> random_points(Random& random, std::size_t n) {
  std::vector<Vector2d> points(n);
  for (auto& p : points) p = {random.uniform(-2, 3), random.uniform(-1, 1)};
  return points;
}

TEST(ConvexHull, HoldsAllPointsAndIsConvex) {
  Random random(3);
  for (const std::size_t n : {3U, 10U, 63U, 65U, 5000U}) {
    const auto points = random_points(random, n);
    const Polygon2 hull = convex_hull(points);
    EXPECT_TRUE(is_convex(hull, 0));
    for (const auto& p : points)
      for (std::size_t i = 0; i < hull.size(); ++i) {
        const Line2 edge{{hull[i].y() - hull[(i + 1) % hull.size()].y(), hull[(i + 1) % hull.size()].x() - hull[i].x()},
                         0};
        EXPECT_GE(edge.side(p) - edge.side(hull[i]), -1e-12);
      }
  }
}

TEST(ConvexHull, OfAGridHasFourCorners) {
  std::vector<Vector2d> points;
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 30; ++j) points.emplace_back(i, j);
  EXPECT_EQ(convex_hull(points).size(), 4U);
  EXPECT_DOUBLE_EQ(area(convex_hull(points)), 49 * 29);
}

TEST(ConvexHull, OfDegeneratePointsIsNoPolygon) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_EQ(convex_hull({{1, 2}, {1, 2}, {1, 2}}).size(), 1U);
  std::vector<Vector2d> line(200);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = {static_cast<double>(i), 2.0 * static_cast<double>(i)};
  EXPECT_EQ(convex_hull(line).size(), 2U);
}

TEST(MinimumAreaRectangle, FindsATurnedRectangle) {
  for (const double degrees : {0.0, 7.0, 45.0, 80.0, 133.0}) {
    const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
    std::vector<Vector2d> points;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 20; ++j) points.push_back(turn * Vector2d(i * 0.1 - 1, j * 0.1 + 3));
    const Rectangle2 r = minimum_area_rectangle(convex_hull(points));
    EXPECT_NEAR(area(r.corners()), 8, 1e-9) << degrees;
  }
}

TEST(MinimumAreaRectangle, IsNeverLargerThanAnyTurnedBoxAndHoldsAllPoints) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    const auto points = random_points(random, 3 + random.index(60));
    const Polygon2 hull = convex_hull(points);
    const Rectangle2 best = minimum_area_rectangle(hull);
    for (int k = 0; k < 180; ++k) {
      const Vector2d axis(std::cos(k * std::numbers::pi / 180), std::sin(k * std::numbers::pi / 180));
      Vector2d low(1e9, 1e9), high(-1e9, -1e9);
      for (const auto& p : points) {
        const Vector2d q(axis.dot(p), Vector2d(-axis.y(), axis.x()).dot(p));
        low = low.cwiseMin(q);
        high = high.cwiseMax(q);
      }
      EXPECT_LE(area(best.corners()), (high - low).prod() + 1e-9);
    }
    for (const auto& p : points) {
      EXPECT_GE(best.axis.dot(p), best.low.x() - 1e-9);
      EXPECT_LE(best.perpendicular().dot(p), best.high.y() + 1e-9);
    }
  }
}

TEST(Cut, PartsAreConvexAndAddUp) {
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    const Polygon2 hull = convex_hull(random_points(random, 12));
    const double a = random.uniform(0, 6.3);
    const Line2 line{{std::cos(a), std::sin(a)}, random.uniform(-2, 2)};
    const CutPolygon parts = cut(hull, line, 1e-9);
    EXPECT_NEAR(area(parts.positive) + area(parts.negative), area(hull), 1e-9);
    for (const auto& p : parts.positive) EXPECT_GE(line.side(p), -1e-9);
    for (const auto& p : parts.negative) EXPECT_LE(line.side(p), 1e-9);
    EXPECT_TRUE(parts.positive.empty() || is_convex(parts.positive, 1e-9));
    EXPECT_TRUE(parts.negative.empty() || is_convex(parts.negative, 1e-9));
  }
}

TEST(Cut, AlongAnEdgeOrThroughACornerMakesNoSliver) {
  const Polygon2 square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(cut(square, {{1, 0}, -1 + 1e-8}, 1e-6).positive.empty());
  EXPECT_EQ(cut(square, {{1, 0}, -1 + 1e-8}, 1e-6).negative.size(), 4U);
  const CutPolygon diagonal = cut(square, {{1, -1}, 0}, 1e-6);
  EXPECT_EQ(diagonal.positive.size(), 3U);
  EXPECT_EQ(diagonal.negative.size(), 3U);
  EXPECT_TRUE(cut(square, {{1, 0}, 5}, 1e-6).negative.empty());
}

TEST(IsConvex, RefusesReflexCornersClockwiseAndFlatPolygons) {
  EXPECT_TRUE(is_convex({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0));
  EXPECT_FALSE(is_convex({{0, 0}, {0, 1}, {1, 1}, {1, 0}}, 0));
  EXPECT_FALSE(is_convex({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}}, 1e-6));
  EXPECT_FALSE(is_convex({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, 1e-6));  // crosses itself
  EXPECT_FALSE(is_convex({{0, 0}, {1, 0}, {2, 0}}, 1e-6));
}

TEST(UprightFrame, IsOrthonormalAndRightHanded) {
  Random random(11);
  for (int round = 0; round < 100; ++round) {
    Vector3d n(random.normal(), random.normal(), round == 0 ? 0 : random.normal());
    if (round == 1) n = -Vector3d::UnitZ();
    n.normalize();
    const Plane plane{n, random.normal()};
    const PlaneFrame frame = upright_frame(plane, {1, 2, 3});
    EXPECT_NEAR((frame.u.cross(frame.v) - n).norm(), 0, 1e-12);
    EXPECT_NEAR(plane.signed_distance(frame.to_space({4, -5})), 0, 1e-12);
    EXPECT_NEAR(frame.u.z(), 0, 1e-12);
    EXPECT_GE(frame.v.z(), -1e-12);
  }
}

std::vector<Vector3d> random_polygon(Random& random, bool flat) {
  Vector3d n = flat ? Vector3d(0, 0, 1) : Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  const PlaneFrame frame = upright_frame({n, random.uniform(-1, 1) * (flat ? 0 : 1)}, {0, 0, 0});
  Polygon2 hull;
  while (hull.size() < 3) {
    std::vector<Vector2d> points(3 + random.index(4));
    const Vector2d centre(random.uniform(-2, 2), random.uniform(-2, 2));
    for (auto& p : points) p = centre + Vector2d(random.uniform(-1, 1), random.uniform(-1, 1));
    hull = convex_hull(points);
  }
  std::vector<Vector3d> corners;
  for (const auto& p : hull) corners.push_back(frame.to_space(p));
  return corners;
}

/// Least distance between points sampled on both polygons: never less than the true one, and little more.
double sampled_distance(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b, int steps) {
  const auto sample = [&](const std::vector<Vector3d>& c) {
    std::vector<Vector3d> points;
    for (std::size_t t = 2; t < c.size(); ++t)
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j)
          points.push_back(c[0] + (c[t - 1] - c[0]) * (static_cast<double>(i) / steps) +
                           (c[t] - c[0]) * (static_cast<double>(j) / steps));
    return points;
  };
  const auto pa = sample(a), pb = sample(b);
  double best = 1e9;
  for (const auto& p : pa)
    for (const auto& q : pb) best = std::min(best, (p - q).norm());
  return best;
}

TEST(PolygonDistance, AgreesWithBruteForceSampling) {
  Random random(13);
  int crossing = 0;
  for (int round = 0; round < 120; ++round) {
    const bool flat = round % 4 == 0;  // both in one plane
    const auto a = random_polygon(random, flat), b = random_polygon(random, flat);
    const double exact = polygon_distance(a, b);
    const double sampled = sampled_distance(a, b, 16);
    EXPECT_LE(exact, sampled + 1e-9);
    EXPECT_GE(exact, sampled - 0.13);  // half a sampling step on each
    EXPECT_DOUBLE_EQ(exact, polygon_distance(b, a));
    if (exact == 0) ++crossing;
  }
  EXPECT_GT(crossing, 5);
}

TEST(PolygonDistance, OfKnownPairs) {
  const std::vector<Vector3d> floor{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  const auto moved = [](std::vector<Vector3d> p, const Vector3d& d) {
    for (auto& c : p) c += d;
    return p;
  };
  EXPECT_DOUBLE_EQ(polygon_distance(floor, moved(floor, {0, 0, 2.5})), 2.5);    // above
  EXPECT_DOUBLE_EQ(polygon_distance(floor, moved(floor, {4.3, 0, 0})), 0.3);    // beside, in one plane
  EXPECT_DOUBLE_EQ(polygon_distance(floor, moved(floor, {4.3, 3.4, 0})), 0.5);  // corner to corner
  EXPECT_EQ(polygon_distance(floor, moved(floor, {1, 1, 0})), 0);               // overlapping in one plane
  EXPECT_EQ(polygon_distance(floor, floor), 0);
  const std::vector<Vector3d> inside{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}};
  EXPECT_EQ(polygon_distance(floor, inside), 0);
  const std::vector<Vector3d> column{{2, 1, 0.4}, {2, 2, 0.4}, {2, 2, 3}, {2, 1, 3}};
  EXPECT_DOUBLE_EQ(polygon_distance(floor, column), 0.4);            // standing over the inside
  EXPECT_EQ(polygon_distance(floor, moved(column, {0, 0, -1})), 0);  // piercing
}

TEST(SegmentPolygonDistance, OfKnownPairs) {
  const std::vector<Vector3d> floor{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  EXPECT_DOUBLE_EQ(segment_polygon_distance({1, 1, 0.4}, {2, 1, 0.6}, floor), 0.4);  // over the inside
  EXPECT_DOUBLE_EQ(segment_polygon_distance({1, -0.3, 0.4}, {2, -0.3, 0.4}, floor), 0.5);
  EXPECT_EQ(segment_polygon_distance({1, 1, -1}, {1, 1, 1}, floor), 0);
  EXPECT_EQ(segment_polygon_distance({1, 1, 0}, {2, 2, 0}, floor), 0);
}

TEST(SegmentDistance, OfParallelCollinearAndPointSegments) {
  EXPECT_DOUBLE_EQ(segment_distance({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), 1);
  EXPECT_DOUBLE_EQ(segment_distance({0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {2, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(segment_distance({0, 0, 0}, {1, 0, 0}, {3, 1, 0}, {1, 1, 0}), 1);
  EXPECT_DOUBLE_EQ(segment_distance({0, 0, 0}, {0, 0, 0}, {3, 4, 0}, {3, 4, 0}), 5);
  EXPECT_DOUBLE_EQ(segment_distance({0, 0, 0}, {0, 0, 0}, {-1, 2, 0}, {1, 2, 0}), 2);
  EXPECT_DOUBLE_EQ(segment_distance({-1, 2, 0}, {1, 2, 0}, {0, 0, 0}, {0, 0, 0}), 2);
  EXPECT_EQ(segment_distance({0, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 0}), 0);
}

}  // namespace
}  // namespace atrium::polygon_test
