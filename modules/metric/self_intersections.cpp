#include "modules/metric/self_intersections.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/geometry/box_tree.hpp"
#include "modules/geometry/exact_sign.hpp"

namespace atrium::metric {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;
using Signs = std::array<int, 3>;

Signs sides(const Corners& of, const Corners& plane) {
  return {plane_side(plane[0], plane[1], plane[2], of[0]), plane_side(plane[0], plane[1], plane[2], of[1]),
          plane_side(plane[0], plane[1], plane[2], of[2])};
}
bool both_sides(const Signs& s) {
  return *std::min_element(s.begin(), s.end()) < 0 && *std::max_element(s.begin(), s.end()) > 0;
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
bool crossing(Corners a, Corners b, const Signs& of_a, const Signs& of_b) {
  const int side_a = first_alone(a, of_a), side_b = first_alone(b, of_b);
  // Guigue and Devillers 2003: both first corners on the positive side of the other's plane. Turning a triangle round
  // changes the other's side.
  if (side_a < 0) std::swap(b[1], b[2]);
  if (side_b < 0) std::swap(a[1], a[2]);
  return plane_side(a[0], a[1], b[0], b[1]) < 0 && plane_side(a[0], a[2], b[2], b[0]) < 0;
}

bool areas_overlap(const Corners& a, const Corners& b) {
  using Flat = std::array<Eigen::Vector2d, 3>;
  // Seen along the first axis on which the triangle has an area: its sign is exact.
  for (int axis = 0; axis < 3; ++axis) {
    const auto flat = [&](const Corners& t) {
      Flat f;
      for (std::size_t i = 0; i < 3; ++i) f[i] = {t[i][(axis + 1) % 3], t[i][(axis + 2) % 3]};
      if (turn_sign(f[0], f[1], f[2]) < 0) std::swap(f[1], f[2]);
      return f;
    };
    const Flat p = flat(a), q = flat(b);
    if (turn_sign(p[0], p[1], p[2]) == 0) continue;
    const auto separates = [](const Flat& t, const Flat& other) {
      for (std::size_t i = 0; i < 3; ++i) {
        bool outside = true;
        for (const auto& x : other) outside = outside && turn_sign(t[i], t[(i + 1) % 3], x) <= 0;
        if (outside) return true;
      }
      return false;
    };
    return !separates(p, q) && !separates(q, p);
  }
  return false;
}

}  // namespace

Meeting meeting(const Corners& a, const Corners& b) {
  const Signs of_a = sides(a, b);
  if (of_a == Signs{0, 0, 0}) return areas_overlap(a, b) ? Meeting::overlap : Meeting::apart;
  if (!both_sides(of_a)) return Meeting::apart;
  const Signs of_b = sides(b, a);
  if (!both_sides(of_b)) return Meeting::apart;
  return crossing(a, b, of_a, of_b) ? Meeting::crossing : Meeting::apart;
}

double crossing_depth(const Corners& a, const Corners& b) {
  const auto depth = [](const Corners& of, const Corners& plane) {
    const Eigen::Vector3d normal = (plane[1] - plane[0]).cross(plane[2] - plane[0]).normalized();
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

SelfIntersections self_intersections(const std::vector<Eigen::Vector3d>& vertices,
                                     const std::vector<Triangle>& triangles, double deep, const Context& context) {
  const auto corners = [&](std::uint32_t t) {
    return Corners{vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]};
  };
  std::vector<Eigen::AlignedBox3d> boxes(triangles.size());
  for (std::uint32_t t = 0; t < boxes.size(); ++t)
    for (const auto v : triangles[t]) boxes[t].extend(vertices[v]);
  const BoxTree tree(boxes, context);
  const auto same_corners = [&](std::uint32_t a, std::uint32_t b) {
    Triangle s = triangles[a], t = triangles[b];
    std::sort(s.begin(), s.end());
    std::sort(t.begin(), t.end());
    return s == t;
  };
  constexpr std::size_t chunk_size = 1024;
  std::vector<SelfIntersections> parts((triangles.size() + chunk_size - 1) / chunk_size);
  context.parallel_chunks(triangles.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    auto& part = parts[chunk];
    for (auto a = static_cast<std::uint32_t>(begin); a < end; ++a) {
      const Corners own = corners(a);
      tree.meeting(boxes[a], [&](std::uint32_t b) {
        if (b <= a) return;
        const auto how = meeting(own, corners(b));
        if (how == Meeting::apart || same_corners(a, b)) return;
        if (how == Meeting::overlap) {
          ++part.overlaps;
        } else {
          ++part.crossings;
          if (crossing_depth(own, corners(b)) > deep) ++part.deep_crossings;
        }
        part.triangles.insert(part.triangles.end(), {a, b});
      });
    }
  });
  SelfIntersections all;
  for (auto& p : parts) {
    all.crossings += p.crossings;
    all.deep_crossings += p.deep_crossings;
    all.overlaps += p.overlaps;
    all.triangles.insert(all.triangles.end(), p.triangles.begin(), p.triangles.end());
  }
  std::sort(all.triangles.begin(), all.triangles.end());
  all.triangles.erase(std::unique(all.triangles.begin(), all.triangles.end()), all.triangles.end());
  return all;
}

}  // namespace atrium::metric
