#include "modules/layout/arrangement.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "graph/api/random.hpp"
#include "modules/geometry/polygon.hpp"

namespace atrium::layout::arrangement_test {
namespace {

using Eigen::Vector2d;
using Line = Arrangement::Line;

constexpr double tolerance = 1e-3;
constexpr double everywhere = 1e9;

Line through(const Vector2d& p, double heading) {
  const Vector2d normal(std::cos(heading), std::sin(heading));
  return {normal, -normal.dot(p)};
}

Polygon2 polygon_of(const Arrangement& arrangement, const Arrangement::Cell& cell) {
  Polygon2 result;
  for (const auto c : cell.corners) result.push_back(arrangement.vertices()[c]);
  return result;
}

std::vector<double> areas(const Arrangement& arrangement) {
  std::vector<double> result;
  for (const auto& cell : arrangement.cells()) result.push_back(area(polygon_of(arrangement, cell)));
  std::sort(result.begin(), result.end());
  return result;
}

/// What is wrong with the cells of a box; "" if they cover it once, side to side, and each side lies on its line.
std::string flaw(const Arrangement& arrangement, const std::map<std::int32_t, Line>& lines, double box_area) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;  // of directed sides
  double total = 0;
  for (const auto& cell : arrangement.cells()) {
    const auto n = cell.corners.size();
    if (n < 3 || cell.lines.size() != n) return "a cell of " + std::to_string(n) + " corners";
    const Polygon2 polygon = polygon_of(arrangement, cell);
    // A corner may stand off either of two lines.
    if (!is_convex(polygon, 2 * tolerance)) return "a cell that is not convex";
    const double own = area(polygon);
    if (!(own > 0)) return "a cell of area " + std::to_string(own);
    total += own;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t from = cell.corners[i], to = cell.corners[(i + 1) % n];
      if (from == to || ++uses[{from, to}] > 1) return "a side used twice";
      if (cell.lines[i] < 0) continue;
      const Line& line = lines.at(cell.lines[i]);
      for (const auto v : {from, to})
        if (std::abs(line.side(arrangement.vertices()[v])) > 1.01 * tolerance) return "a side off its line";
    }
  }
  double border = 0;
  for (const auto& [side, count] : uses)
    if (uses.count({side.second, side.first}) == 0)
      border += (arrangement.vertices()[side.first] - arrangement.vertices()[side.second]).norm();
  if (std::abs(border - 4 * std::sqrt(box_area)) > 1e-9) return "a border of " + std::to_string(border) + " m";
  if (std::abs(total - box_area) > 1e-9 * box_area) return "area " + std::to_string(total);
  return "";
}

/// A box of 10 × 10 m.
struct Box {
  Arrangement arrangement{{0, 0}, {10, 10}, tolerance};
  std::map<std::int32_t, Line> lines;

  Box& cut(const Line& line, double begin = -everywhere, double end = everywhere) {
    const auto id = static_cast<std::int32_t>(lines.size());
    lines[id] = line;
    arrangement.cut(id, line, begin, end);
    return *this;
  }
  std::string flaw() const { return arrangement_test::flaw(arrangement, lines, 100); }
};

TEST(Arrangement, AGridOfLines) {
  Box box;
  for (int i = 1; i < 5; ++i) box.cut(through({2.0 * i, 0}, 0)).cut(through({0, 2.0 * i}, std::numbers::pi / 2));
  EXPECT_EQ(box.flaw(), "");
  EXPECT_EQ(box.arrangement.cells().size(), 25U);
  EXPECT_EQ(box.arrangement.vertices().size(), 36U);
  for (const double a : areas(box.arrangement)) EXPECT_NEAR(a, 4, 1e-9);
}

TEST(Arrangement, AShortLineEndsAtOthers) {
  Box box;
  box.cut(through({5, 0}, 0));  // x = 5
  // y = 5, seen on x of 6 to 7 only; coordinates along the line run to −x.
  box.cut(through({0, 5}, std::numbers::pi / 2), -7, -6);
  EXPECT_EQ(box.flaw(), "");
  ASSERT_EQ(box.arrangement.cells().size(), 3U);
  const auto found = areas(box.arrangement);
  EXPECT_NEAR(found[0], 25, 1e-9);
  EXPECT_NEAR(found[1], 25, 1e-9);
  EXPECT_NEAR(found[2], 50, 1e-9);
}

TEST(Arrangement, LinesThatMissLeaveEverything) {
  Box box;
  box.cut(through({-1, 5}, 0)).cut(through({11, 11}, 0.7)).cut(through({5, 5}, 0), 20, 30);
  // Along a side of the box, and within the tolerance of one.
  box.cut(through({0, 0}, 0)).cut(through({10 - tolerance / 2, 0}, 0));
  EXPECT_EQ(box.flaw(), "");
  EXPECT_EQ(box.arrangement.cells().size(), 1U);
}

TEST(Arrangement, ALineThroughVerticesMakesNoSlivers) {
  Box box;
  box.cut(through({5, 0}, 0)).cut(through({0, 5}, std::numbers::pi / 2));
  // The diagonal, missing the crossing and the corners by less than the tolerance.
  box.cut(through({5 + 0.5 * tolerance, 5}, 0.75 * std::numbers::pi));
  EXPECT_EQ(box.flaw(), "");
  EXPECT_EQ(box.arrangement.cells().size(), 6U);
  EXPECT_EQ(box.arrangement.vertices().size(), 9U);
}

TEST(Arrangement, TheSameLineTwiceIsOne) {
  Box box;
  const Line line = through({4, 4}, 0.6);
  box.cut(line).cut(line).cut({-line.normal, -line.offset}).cut({line.normal, line.offset + 0.5 * tolerance});
  EXPECT_EQ(box.flaw(), "");
  EXPECT_EQ(box.arrangement.cells().size(), 2U);
}

// n lines in general position with k crossings inside of a convex region cut it into 1 + n + k.
RC_GTEST_PROP(Arrangement, CountsAsEulerSays, (std::uint32_t seed)) {
  Random random(seed);
  std::vector<Line> lines;
  for (std::uint64_t i = 0; i < 1 + random.index(10); ++i)
    lines.push_back(through({random.uniform(1, 9), random.uniform(1, 9)}, random.uniform(-3.2, 3.2)));
  std::size_t crossings = 0;
  std::vector<Vector2d> places;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      Eigen::Matrix2d m;
      m << lines[i].normal.transpose(), lines[k].normal.transpose();
      RC_PRE(std::abs(m.determinant()) > 0.05);
      const Vector2d p = m.inverse() * Vector2d(-lines[i].offset, -lines[k].offset);
      for (const double d : {p.x(), p.y(), p.x() - 10, p.y() - 10}) RC_PRE(std::abs(d) > 0.02);
      for (const auto& other : places) RC_PRE((p - other).norm() > 0.1);
      places.push_back(p);
      if (p.x() > 0 && p.y() > 0 && p.x() < 10 && p.y() < 10) ++crossings;
    }
  // Lines that pass a corner of the box, or the crossing of two others, within the tolerance count otherwise.
  for (const auto& line : lines) {
    int near = 0;
    for (const auto& p : places) near += std::abs(line.side(p)) < 0.02 ? 1 : 0;
    RC_PRE(near == static_cast<int>(lines.size()) - 1);
    for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(10, 0), Vector2d(10, 10), Vector2d(0, 10)})
      RC_PRE(std::abs(line.side(corner)) > 0.02);
  }
  Box box, other;
  for (const auto& line : lines) box.cut(line);
  for (auto it = lines.rbegin(); it != lines.rend(); ++it) other.cut(*it);
  RC_ASSERT(box.flaw() == "");
  RC_ASSERT(box.arrangement.cells().size() == 1 + lines.size() + crossings);
  RC_ASSERT(box.arrangement.vertices().size() == 4 + 2 * lines.size() + crossings);
  // The order of the lines does not matter.
  const auto a = areas(box.arrangement), b = areas(other.arrangement);
  RC_ASSERT(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) RC_ASSERT(std::abs(a[i] - b[i]) < 1e-9);
}

// The hard ones: parallel within a hair, concurrent, through vertices that are there, pieces of lines.
RC_GTEST_PROP(Arrangement, IsSoundForLinesThatNearlyCoincide, (std::uint32_t seed)) {
  Random random(seed);
  Box box;
  const Vector2d centre(random.uniform(2, 8), random.uniform(2, 8));
  const double heading = random.uniform(-3.2, 3.2);
  for (int i = 0; i < 25; ++i) {
    const auto& vertices = box.arrangement.vertices();
    const Vector2d vertex = vertices[random.index(vertices.size())];
    const double hair = std::pow(10, random.uniform(-7, -1)) * (random.uniform() < 0.5 ? 1 : -1);
    Line line;
    switch (random.index(5)) {
      case 0: line = through({random.uniform(0, 10), random.uniform(0, 10)}, random.uniform(-3.2, 3.2)); break;
      case 1: line = through(centre + Vector2d(hair, hair), random.uniform(-3.2, 3.2)); break;
      case 2: line = through(vertex, random.uniform(-3.2, 3.2)); break;
      case 3: line = through(vertex + Vector2d(hair, 0), heading + hair); break;
      default: line = through({random.uniform(0, 10), random.uniform(0, 10)}, heading + hair); break;
    }
    if (random.uniform() < 0.3)
      box.cut(line);
    else {
      const double at = line.along().dot(centre) + random.uniform(-4, 4);
      box.cut(line, at, at + random.uniform(0, 5));
    }
    const auto found = box.flaw();
    if (!found.empty()) RC_FAIL("after line " + std::to_string(i) + ": " + found);
  }
}

TEST(Arrangement, LongEdgesOfManyLinesStayOnThem) {
  // A fan of 60 lines through one place, each turned by 3°, and as many parallel ones 2 mm apart.
  Box box;
  for (int i = 0; i < 60; ++i) box.cut(through({5, 5}, i * std::numbers::pi / 60));
  for (int i = 0; i < 60; ++i) box.cut(through({3 + 0.002 * i, 0}, 1e-5 * i));
  EXPECT_EQ(box.flaw(), "");
}

}  // namespace
}  // namespace atrium::layout::arrangement_test
