#include "modules/metric/triangle_meeting.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/geometry/exact_sign.hpp"

namespace atrium::metric {
namespace {

using V2 = Eigen::Vector2d;
using V3 = Eigen::Vector3d;
using Flat = std::array<V2, 3>;
using Signs = std::array<int, 3>;

Signs sides(const Corners& of, const Corners& plane) {
  return {plane_side(plane[0], plane[1], plane[2], of[0]), plane_side(plane[0], plane[1], plane[2], of[1]),
          plane_side(plane[0], plane[1], plane[2], of[2])};
}
bool both_sides(const Signs& s) {
  return *std::min_element(s.begin(), s.end()) < 0 && *std::max_element(s.begin(), s.end()) > 0;
}
bool one_side(const Signs& s) { return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0); }

// Seen along an axis: coordinates are taken over as they are, so signs stay exact.
V2 along(const V3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

// The triangle along the first axis on which it has an area, counter-clockwise.
Flat flattened(const Corners& t, int& axis) {
  for (axis = 0; axis < 3; ++axis) {
    Flat f{along(t[0], axis), along(t[1], axis), along(t[2], axis)};
    const int turn = turn_sign(f[0], f[1], f[2]);
    if (turn < 0) std::swap(f[1], f[2]);
    if (turn != 0) return f;
  }
  axis = 0;
  return {};
}
Flat flattened_along(const Corners& t, int axis) {
  Flat f{along(t[0], axis), along(t[1], axis), along(t[2], axis)};
  if (turn_sign(f[0], f[1], f[2]) < 0) std::swap(f[1], f[2]);
  return f;
}

// Turns the corners so that the first is alone on its side (the others are on the other or on the plane). Returns that
// side.
int first_alone(Corners& t, Signs s) {
  for (int i = 0; i < 3; ++i) {
    if (s[0] != 0 && s[1] != s[0] && s[2] != s[0]) break;
    t = {t[1], t[2], t[0]};
    s = {s[1], s[2], s[0]};
  }
  return s[0];
}

// With (0, +, −) both signs stand alone: either serves.
bool insides_cross(Corners a, Corners b, const Signs& of_a, const Signs& of_b) {
  const int side_a = first_alone(a, of_a), side_b = first_alone(b, of_b);
  // Guigue and Devillers 2003: both first corners on the positive side of the other's plane. Turning a triangle round
  // changes the other's side.
  if (side_a < 0) std::swap(b[1], b[2]);
  if (side_b < 0) std::swap(a[1], a[2]);
  return plane_side(a[0], a[1], b[0], b[1]) < 0 && plane_side(a[0], a[2], b[2], b[0]) < 0;
}

bool areas_overlap(const Corners& a, const Corners& b) {
  int axis = 0;
  const Flat p = flattened(a, axis), q = flattened_along(b, axis);
  const auto separates = [](const Flat& t, const Flat& other) {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::all_of(other.begin(), other.end(), [&](const V2& x) { return turn_sign(t[i], t[(i + 1) % 3], x) <= 0; }))
        return true;
    return false;
  };
  return !separates(p, q) && !separates(q, p);
}

// Whether x, on the line through p and q, lies between them or on one.
bool between(const V2& x, const V2& p, const V2& q) {
  return x.x() >= std::min(p.x(), q.x()) && x.x() <= std::max(p.x(), q.x()) && x.y() >= std::min(p.y(), q.y()) &&
         x.y() <= std::max(p.y(), q.y());
}
bool segments_meet(const V2& p, const V2& q, const V2& r, const V2& s) {
  const int pr = turn_sign(p, q, r), ps = turn_sign(p, q, s), rp = turn_sign(r, s, p), rq = turn_sign(r, s, q);
  if (pr * ps < 0 && rp * rq < 0) return true;
  return (pr == 0 && between(r, p, q)) || (ps == 0 && between(s, p, q)) || (rp == 0 && between(p, r, s)) ||
         (rq == 0 && between(q, r, s));
}
bool holds(const Flat& t, const V2& x) {
  return turn_sign(t[0], t[1], x) >= 0 && turn_sign(t[1], t[2], x) >= 0 && turn_sign(t[2], t[0], x) >= 0;
}

// Whether the segment and the triangle, both with their borders, have a point in common.
bool hits(const V3& p, const V3& q, int side_p, int side_q, const Corners& t) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    int axis = 0;
    const Flat flat = flattened(t, axis);
    const V2 from = along(p, axis), to = along(q, axis);
    return holds(flat, from) || segments_meet(from, to, flat[0], flat[1]) ||
           segments_meet(from, to, flat[1], flat[2]) || segments_meet(from, to, flat[2], flat[0]);
  }
  const int first = plane_side(p, q, t[0], t[1]), second = plane_side(p, q, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = plane_side(p, q, t[2], t[0]);
  return first * third >= 0 && second * third >= 0;
}

// Without common corners the triangles meet if an edge of one hits the other. With a common one they meet elsewhere if
// one of the edges opposite to it does: a ray from it that runs in both leaves the smaller there. `shared`: the corner
// of each that is common, or -1.
bool edges_hit(const Corners& a, const Corners& b, const Signs& of_a, int shared) {
  for (int i = 0; i < 3; ++i) {
    if (shared >= 0 && i != (shared + 1) % 3) continue;
    const int k = (i + 1) % 3;
    if (hits(a[i], a[k], of_a[i], of_a[k], b)) return true;
  }
  return false;
}

struct Common {
  int count = 0, of_a = -1, of_b = -1;
};
Common common_corners(const Corners& a, const Corners& b) {
  Common common;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (a[i] == b[k]) common = {common.count + 1, i, k};
  return common;
}

}  // namespace

Meeting meeting(const Corners& a, const Corners& b) {
  const Common common = common_corners(a, b);
  const Signs of_a = sides(a, b);
  if (one_side(of_a)) return Meeting::apart;
  if (of_a == Signs{0, 0, 0} && areas_overlap(a, b)) return Meeting::overlap;
  if (common.count >= 2) return Meeting::apart;  // over a common edge triangles can do nothing but overlap
  const Signs of_b = sides(b, a);
  if (one_side(of_b)) return Meeting::apart;
  if (both_sides(of_a) && both_sides(of_b) && insides_cross(a, b, of_a, of_b)) return Meeting::crossing;
  return edges_hit(a, b, of_a, common.of_a) || edges_hit(b, a, of_b, common.of_b) ? Meeting::touching : Meeting::apart;
}

bool enters(const V3& p, const V3& q, const Corners& triangle) {
  int axis = 0;
  const Flat t = flattened(triangle, axis);
  const V2 from = along(p, axis), to = along(q, axis);
  // Two convex sets, one of them open, are apart if a line through a side of either parts them.
  Signs corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (turn_sign(t[i], t[(i + 1) % 3], from) <= 0 && turn_sign(t[i], t[(i + 1) % 3], to) <= 0) return false;
    corners[i] = turn_sign(from, to, t[i]);
  }
  return both_sides(corners);
}

bool share_piece(const V3& p, const V3& q, const V3& r, const V3& s) {
  for (int axis = 0; axis < 3; ++axis) {
    if (turn_sign(along(p, axis), along(q, axis), along(r, axis)) != 0) return false;
    if (turn_sign(along(p, axis), along(q, axis), along(s, axis)) != 0) return false;
  }
  for (int k = 0; k < 3; ++k)
    if (p[k] != q[k])
      return std::max(std::min(p[k], q[k]), std::min(r[k], s[k])) <
             std::min(std::max(p[k], q[k]), std::max(r[k], s[k]));
  return false;
}

bool strips_cross(const V3& p, const V3& q, const std::array<V3, 2>& one, const std::array<V3, 2>& other) {
  // The quarter of a point, going round the line from `from`: 0 there, 1 in the half turn behind it, 2 opposite, 3.
  const auto quarter = [&](const V3& from, const V3& x) {
    const int side = plane_side(p, q, from, x);
    if (side != 0) return side < 0 ? 1 : 3;
    int axis = 0;
    flattened({p, q, from}, axis);
    const auto turn = [&](const V3& c) { return turn_sign(along(p, axis), along(q, axis), along(c, axis)); };
    return turn(from) == turn(x) ? 0 : 2;
  };
  // −1, 0, 1: one comes to x before, with, after it comes to y.
  const auto order = [&](const V3& from, const V3& x, const V3& y) {
    const int at_x = quarter(from, x), at_y = quarter(from, y);
    if (at_x != at_y) return at_x < at_y ? -1 : 1;
    return at_x % 2 == 0 ? 0 : plane_side(p, q, x, y);
  };
  const int first = order(one[0], other[0], one[1]), second = order(one[0], other[1], one[1]);
  const bool along_one = quarter(one[0], other[0]) == 0 || quarter(one[0], other[1]) == 0;
  return !along_one && first * second < 0;
}

double crossing_depth(const Corners& a, const Corners& b) {
  const auto depth = [](const Corners& of, const Corners& plane) {
    const V3 normal = (plane[1] - plane[0]).cross(plane[2] - plane[0]).normalized();
    double above = 0, below = 0;
    for (const auto& p : of) {
      const double d = normal.dot(p - plane[0]);
      above = std::max(above, d);
      below = std::max(below, -d);
    }
    return std::min(above, below);
  };
  return std::min(depth(a, b), depth(b, a));
}

}  // namespace atrium::metric
