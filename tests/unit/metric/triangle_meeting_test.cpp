#include "modules/metric/triangle_meeting.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <boost/rational.hpp>
#include <map>
#include <optional>

#include "graph/api/random.hpp"

namespace atrium::metric::triangle_meeting_test {
namespace {

using V = Eigen::Vector3d;
using Number = boost::rational<long long>;
using Point = std::array<Number, 3>;
using Points = std::array<Point, 3>;
const Number none(0);  // Boost 1.74 compares with plain integers without end in C++20

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Number dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point normal(const Points& t) { return cross(t[1] - t[0], t[2] - t[0]); }
bool is_zero(const Point& p) { return p == Point{}; }

/// 1 in the inside, 0 on the border, -1 outside, the plane's outside too.
int place(const Points& t, const Point& x) {
  const Point n = normal(t);
  if (dot(n, x - t[0]) != none) return -1;
  int least = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Number side = dot(n, cross(t[(i + 1) % 3] - t[i], x - t[i]));
    least = std::min(least, side > none ? 1 : side < none ? -1 : 0);
  }
  return least;
}

/// Every corner of what two triangles have in common, in fractions: corners of one in the other, edges of one through
/// the plane of the other, edges through edges.
std::vector<Point> common_corners(const Points& a, const Points& b) {
  std::vector<Point> candidates;
  const auto through = [&](const Point& p, const Point& q, const Point& n, const Point& on) {
    const Number at_p = dot(n, p - on), at_q = dot(n, q - on);
    if (at_p == at_q) return;
    const Number s = at_p / (at_p - at_q);
    candidates.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
  };
  for (const auto& [one, other] : {std::pair{a, b}, std::pair{b, a}})
    for (std::size_t i = 0; i < 3; ++i) {
      candidates.push_back(one[i]);
      through(one[i], one[(i + 1) % 3], normal(other), other[0]);
      for (std::size_t k = 0; k < 3; ++k)  // the plane that stands on the other's edge
        through(one[i], one[(i + 1) % 3], cross(normal(other), other[(k + 1) % 3] - other[k]), other[k]);
    }
  std::vector<Point> common;
  for (const auto& c : candidates)
    if (place(a, c) >= 0 && place(b, c) >= 0) common.push_back(c);
  std::sort(common.begin(), common.end());
  common.erase(std::unique(common.begin(), common.end()), common.end());
  return common;
}

Meeting by_fractions(const Points& a, const Points& b) {
  const auto common = common_corners(a, b);
  const bool only_corners = std::all_of(common.begin(), common.end(), [&](const Point& p) {
    return std::find(a.begin(), a.end(), p) != a.end() && std::find(b.begin(), b.end(), p) != b.end();
  });
  bool area = false;
  for (std::size_t i = 2; i < common.size(); ++i)
    area = area || !is_zero(cross(common[1] - common[0], common[i] - common[0]));
  if (area) return Meeting::overlap;
  if (only_corners) return Meeting::apart;
  Point middle{};
  for (const auto& c : common)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += c[k] / static_cast<long long>(common.size());
  return place(a, middle) == 1 && place(b, middle) == 1 ? Meeting::crossing : Meeting::touching;
}

Corners doubles(const Points& t) {
  Corners c;
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) c[i][k] = boost::rational_cast<double>(t[i][static_cast<std::size_t>(k)]);
  return c;
}
std::optional<Points> on_raster(Random& random, double size) {
  Points t;
  for (auto& p : t)
    for (auto& x : p) x = static_cast<long long>(std::floor(random.uniform(0, size)));
  if (is_zero(normal(t))) return std::nullopt;
  return t;
}

TEST(TriangleMeeting, AgreesWithFractionsOnRasters) {
  Random random(3);
  std::map<std::pair<double, Meeting>, int> seen;
  for (int i = 0; i < 30000; ++i) {
    const double size = i % 2 == 0 ? 3 : 5;
    const auto a = on_raster(random, size), b = on_raster(random, size);
    if (!a || !b) continue;
    const auto expected = by_fractions(*a, *b);
    const auto p = doubles(*a), q = doubles(*b);
    ASSERT_EQ(meeting(p, q), expected) << i;
    ASSERT_EQ(meeting(q, p), expected) << i;
    ASSERT_EQ(meeting({p[2], p[1], p[0]}, {q[1], q[2], q[0]}), expected) << i;
    ++seen[{size, expected}];
  }
  for (const double size : {3.0, 5.0})
    for (const auto how : {Meeting::apart, Meeting::touching, Meeting::crossing, Meeting::overlap})
      EXPECT_GT((seen[{size, how}]), 5) << size << " " << static_cast<int>(how);
}

TEST(TriangleMeeting, EdgesInFacesAgreeWithFractions) {
  Random random(5);
  int inside = 0, outside = 0;
  for (int i = 0; i < 60000; ++i) {
    const auto t = on_raster(random, 4), s = on_raster(random, 4);
    if (!t || !s) continue;
    const Point n = normal(*t), p = (*s)[0], q = (*s)[1];
    if (dot(n, p - (*t)[0]) != none || dot(n, q - (*t)[0]) != none) continue;
    // A piece lies in the inside if the middle of what a triangle over the edge has in common with the face does.
    const Points standing{p, q, {p[0] + n[0], p[1] + n[1], p[2] + n[2]}};
    const auto common = common_corners(*t, standing);
    bool expected = false;
    if (!common.empty()) {
      Point middle{};
      for (const auto& c : common)
        for (std::size_t k = 0; k < 3; ++k) middle[k] += c[k] / static_cast<long long>(common.size());
      expected = place(*t, middle) == 1;
    }
    const auto edge = doubles(*s);
    ASSERT_EQ(enters(edge[0], edge[1], doubles(*t)), expected) << i;
    ASSERT_EQ(enters(edge[1], edge[0], doubles(*t)), expected) << i;
    ++(expected ? inside : outside);
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
}

TEST(TriangleMeeting, EdgesOnOneLine) {
  const V p(1, 1, 1), q(3, 5, 7);  // direction (2, 4, 6)
  EXPECT_TRUE(share_piece(p, q, p, q));
  EXPECT_TRUE(share_piece(p, q, V(2, 3, 4), V(5, 9, 13)));
  EXPECT_TRUE(share_piece(p, q, V(5, 9, 13), V(2, 3, 4)));
  EXPECT_FALSE(share_piece(p, q, q, V(5, 9, 13)));  // end to end
  EXPECT_FALSE(share_piece(p, q, V(4, 7, 10), V(5, 9, 13)));
  EXPECT_FALSE(share_piece(p, q, V(2, 3, 4), V(5, 9, 13.5)));
  EXPECT_FALSE(share_piece(p, q, V(2, 3, 4.5), V(5, 9, 13.5)));
}

TEST(TriangleMeeting, StripsThatTakeTurnsCross) {
  // Round the z axis, eight directions: strips cross if just one half of the other lies between the first's halves.
  const std::array<V, 8> round{V(1, 0, 0),  V(1, 1, 5),   V(0, 2, 0),  V(-3, 3, 1),
                               V(-1, 0, 2), V(-1, -1, 0), V(0, -7, 0), V(2, -2, 3)};
  const V p(0, 0, -1), q(0, 0, 2);
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = 0; b < 8; ++b)
      for (std::size_t c = 0; c < 8; ++c)
        for (std::size_t d = 0; d < 8; ++d) {
          const auto after = [&](std::size_t x) { return (x + 8 - a) % 8; };
          const bool apart = c != a && c != b && d != a && d != b;
          const bool expected = a != b && apart && (after(c) < after(b)) != (after(d) < after(b));
          if (a == b) continue;
          ASSERT_EQ(strips_cross(p, q, {round[a], round[b]}, {round[c], round[d]}), expected) << a << b << c << d;
          ASSERT_EQ(strips_cross(q, p, {round[a], round[b]}, {round[c], round[d]}), expected);
        }
}

}  // namespace
}  // namespace atrium::metric::triangle_meeting_test
