#include "modules/geometry/ear_clipping.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "graph/api/random.hpp"

namespace atrium::ear_clipping_test {
namespace {

using Eigen::Vector2d;

PlanRing rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
PlanRing reversed(PlanRing ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

std::vector<Vector2d> corners_of(const PlanPolygon& polygon) {
  std::vector<Vector2d> result = polygon.outline;
  for (const auto& hole : polygon.holes) result.insert(result.end(), hole.begin(), hole.end());
  return result;
}
/// Sides of the polygon as pairs of corners, in its winding.
std::set<std::pair<std::uint32_t, std::uint32_t>> sides_of(const PlanPolygon& polygon) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> result;
  std::uint32_t first = 0;
  const auto add = [&](const PlanRing& ring) {
    const auto n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < n; ++i) result.insert({first + i, first + (i + 1) % n});
    first += n;
  };
  add(polygon.outline);
  for (const auto& hole : polygon.holes) add(hole);
  return result;
}

/// What is wrong with the triangles; "" if they are a partition of the polygon between its corners. Where all are
/// counter-clockwise and their sides cancel but for the polygon's, they cover it once.
std::string flaw(const PlanPolygon& polygon) {
  const auto points = corners_of(polygon);
  const auto triangles = clip_ears(polygon);
  if (triangles.size() != points.size() + 2 * polygon.holes.size() - 2)
    return std::to_string(triangles.size()) + " triangles";
  std::set<std::pair<std::uint32_t, std::uint32_t>> open;
  double total = 0;
  for (const auto& t : triangles) {
    const Vector2d b = points[t[1]] - points[t[0]], c = points[t[2]] - points[t[0]];
    const double twice = b.x() * c.y() - b.y() * c.x();
    if (!(twice > 0)) return "a triangle of area " + std::to_string(twice / 2);
    total += twice / 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i], to = t[(i + 1) % 3];
      if (open.erase({to, from}) == 0 && !open.insert({from, to}).second) return "a side used twice in one direction";
    }
  }
  if (open != sides_of(polygon)) return "other sides than the polygon's are open";
  if (std::abs(total - polygon.area()) > 1e-9 * polygon.area()) return "area " + std::to_string(total);
  return "";
}

/// Corners around `middle` at distances between `least` and `most`.
PlanRing star(Random& random, const Vector2d& middle, std::uint64_t corners, double least, double most) {
  PlanRing ring;
  const double start = random.uniform(0, 1);
  for (std::uint64_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + start) / static_cast<double>(corners);
    ring.emplace_back(middle + random.uniform(least, most) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return ring;
}
PlanRing with_middles(const PlanRing& ring) {
  PlanRing result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    result.push_back(ring[i]);
    result.emplace_back((ring[i] + ring[(i + 1) % ring.size()]) / 2);
  }
  return result;
}

TEST(EarClipping, CoversAPolygonWithHoles) {
  EXPECT_EQ(flaw({rectangle(0, 0, 10, 8),
                  {reversed(rectangle(1, 1, 3, 3)), reversed(rectangle(5, 1, 6, 7)), reversed(rectangle(1, 5, 2, 6))}}),
            "");
}

RC_GTEST_PROP(EarClipping, CoversStars, (std::uint32_t seed)) {
  Random random(seed);
  const PlanPolygon polygon{star(random, {0, 0}, 3 + random.index(30), 0.2, 1), {}};
  RC_ASSERT(flaw(polygon) == "");
}

RC_GTEST_PROP(EarClipping, CoversStarsWithHoles, (std::uint32_t seed)) {
  Random random(seed);
  PlanPolygon polygon{star(random, {0, 0}, 8 + random.index(12), 2, 3), {}};
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      if (random.uniform() < 0.5)
        polygon.holes.push_back(reversed(star(random, Vector2d(x, y) * 0.8, 3 + random.index(6), 0.1, 0.38)));
  RC_ASSERT(flaw(polygon) == "");
}

// Columns in a row, corners in line with each other and with those of the room: bridges of equal length everywhere.
RC_GTEST_PROP(EarClipping, CoversARoomWithAlignedColumns, (std::uint32_t seed)) {
  Random random(seed);
  PlanPolygon polygon{rectangle(0, 0, 9, 9), {}};
  for (int x = 1; x < 8; x += 2)
    for (int y = 1; y < 8; y += 2)
      if (random.uniform() < 0.4) polygon.holes.push_back(reversed(rectangle(x, y, x + 1, y + 1)));
  for (auto& hole : polygon.holes)
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(random.index(4)), hole.end());
  RC_ASSERT(flaw(polygon) == "");
}

// T-junctions: a wall that meets another one in the middle leaves a corner on a straight side.
RC_GTEST_PROP(EarClipping, CornersOnSidesMakeNoFlatTriangles, (std::uint32_t seed)) {
  Random random(seed);
  PlanPolygon polygon{with_middles(with_middles(rectangle(0, 0, 8, 8))), {}};
  for (int x = 1; x < 8; x += 4)
    for (int y = 1; y < 8; y += 4)
      if (random.uniform() < 0.5) polygon.holes.push_back(reversed(with_middles(rectangle(x, y, x + 2, y + 2))));
  RC_ASSERT(flaw(polygon) == "");
}

TEST(EarClipping, TurningAndMovingChangesNothing) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    PlanPolygon polygon{with_middles(rectangle(0, 0, 8, 5)),
                        {reversed(with_middles(rectangle(1, 1, 2, 4))), reversed(rectangle(4, 2, 6, 3))}};
    const Eigen::Rotation2Dd turn(random.uniform(-3, 3));
    const Vector2d shift(random.uniform(-500, 500), random.uniform(-500, 500));
    for (auto& p : polygon.outline) p = turn * p + shift;
    for (auto& hole : polygon.holes)
      for (auto& p : hole) p = turn * p + shift;
    const auto triangles = clip_ears(polygon);
    const auto points = corners_of(polygon);
    double total = 0;
    for (const auto& t : triangles) {
      const double area = PlanPolygon{{points[t[0]], points[t[1]], points[t[2]]}, {}}.area();
      EXPECT_GT(area, 1e-6);  // corners on a side, but for rounding
      total += area;
    }
    EXPECT_NEAR(total, polygon.area(), 1e-6);
  }
}

TEST(EarClipping, HolesThatTouchEachOtherOrTheOutlineInACorner) {
  // Two columns corner to corner; a column whose corner is one of the room's.
  for (const auto& polygon :
       {PlanPolygon{rectangle(0, 0, 6, 6), {reversed(rectangle(1, 1, 2, 2)), reversed(rectangle(2, 2, 3, 3))}},
        PlanPolygon{{{0, 0}, {3, 0}, {6, 0}, {6, 6}, {0, 6}}, {{{3, 0}, {2, 2}, {4, 2}}}}}) {
    const auto triangles = clip_ears(polygon);
    const auto points = corners_of(polygon);
    EXPECT_EQ(triangles.size(), points.size() + 2 * polygon.holes.size() - 2 - 2);
    double total = 0;
    for (const auto& t : triangles) {
      const Vector2d b = points[t[1]] - points[t[0]], c = points[t[2]] - points[t[0]];
      const double area = (b.x() * c.y() - b.y() * c.x()) / 2;
      EXPECT_GT(area, 0);
      total += area;
    }
    EXPECT_NEAR(total, polygon.area(), 1e-9);
  }
}

TEST(EarClipping, BadInputHasAnAnswer) {
  EXPECT_TRUE(clip_ears({}).empty());
  EXPECT_TRUE(clip_ears({{{0, 0}, {1, 1}}, {}}).empty());
  EXPECT_EQ(clip_ears({{{0, 0}, {1, 0}, {2, 0}}, {}}).size(), 1U);                    // a line
  EXPECT_EQ(clip_ears({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}}).size(), 2U);            // crosses itself
  EXPECT_EQ(clip_ears({reversed(rectangle(0, 0, 1, 1)), {}}).size(), 2U);             // clockwise
  EXPECT_EQ(clip_ears({{{1, 1}, {1, 1}, {1, 1}, {1, 1}}, {}}).size(), 2U);            // one place
  EXPECT_EQ(clip_ears({rectangle(0, 0, 1, 1), {rectangle(5, 5, 6, 6)}}).size(), 8U);  // a hole elsewhere
  EXPECT_EQ(clip_ears({rectangle(0, 0, 1, 1), {{}}}).size(), 2U);                     // an empty hole
}

}  // namespace
}  // namespace atrium::ear_clipping_test
