#include "modules/layout/face_rings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace atrium::layout {
namespace {

constexpr std::uint32_t no_vertex = 0xffffffffU;

/// A vertex of rings and its neighbours in them.
struct Corner {
  std::uint32_t a = no_vertex, b = no_vertex;
  bool kept = false;  ///< rings differ in its neighbours
  double off = 0;     ///< how far what was dropped beside it stands off the edges that are left
};

/// How far `here` stands off the way from `before` to `next`; infinite if it is not between them.
double off_chord(const Eigen::Vector3d& before, const Eigen::Vector3d& here, const Eigen::Vector3d& next) {
  const Eigen::Vector3d chord = (next - before).normalized();
  const Eigen::Vector3d off = here - before;
  if (off.dot(chord) <= 0 || (next - here).dot(chord) <= 0) return std::numeric_limits<double>::infinity();
  return (off - chord * off.dot(chord)).norm();
}

/// The angle by which one turns to the left at b on the way from a to c, −π … π.
double turn(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
            const Eigen::Vector3d& normal) {
  const Eigen::Vector3d in = b - a;
  const Eigen::Vector3d out = c - b;
  return std::atan2(normal.dot(in.cross(out)), in.dot(out));
}

}  // namespace

std::vector<Ring> joined_rings(const std::vector<Ring>& polygons, const std::vector<Eigen::Vector3d>& vertices,
                               const Eigen::Vector3d& normal) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const auto& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::uint32_t a = polygon[i];
      const std::uint32_t b = polygon[(i + 1) % polygon.size()];
      if (a == b) continue;
      if (sides.erase({b, a}) == 0) sides.insert({a, b});
    }
  std::vector<Ring> rings;
  while (!sides.empty()) {
    Ring ring;
    auto [first, at] = *sides.begin();
    std::uint32_t before = first;
    sides.erase(sides.begin());
    ring.push_back(first);
    while (at != first) {
      ring.push_back(at);
      // Of several ways on, the one most to the left: parts that touch in a corner stay apart.
      auto best = sides.end();
      double most = -4;
      for (auto it = sides.lower_bound({at, 0}); it != sides.end() && it->first == at; ++it) {
        double left = turn(vertices[before], vertices[at], vertices[it->second], normal);
        if (left > std::numbers::pi - 1e-9) left = -std::numbers::pi;  // back where it came from: last of all
        if (left <= most) continue;
        most = left;
        best = it;
      }
      if (best == sides.end()) break;
      before = at;
      at = best->second;
      sides.erase(best);
    }
    if (ring.size() > 2) rings.push_back(std::move(ring));
  }
  return rings;
}

double signed_area(const Ring& ring, const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& normal) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < ring.size(); ++i)
    sum += (vertices[ring[i - 1]] - vertices[ring[0]]).cross(vertices[ring[i]] - vertices[ring[0]]);
  return normal.dot(sum) / 2;
}

bool ring_contains(const Ring& ring, const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& normal,
                   const Eigen::Vector3d& place) {
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  const double x = u.dot(place);
  const double y = v.dot(place);
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector3d& p = vertices[ring[i]];
    const Eigen::Vector3d& q = vertices[ring[(i + 1) % ring.size()]];
    const double py = v.dot(p);
    const double qy = v.dot(q);
    if ((py > y) == (qy > y)) continue;
    if (x < u.dot(p) + (u.dot(q) - u.dot(p)) * (y - py) / (qy - py)) inside = !inside;
  }
  return inside;
}

std::vector<bool> straight_corners(const std::vector<const Ring*>& rings, const std::vector<Eigen::Vector3d>& vertices,
                                   double tolerance) {
  std::vector<Corner> corners(vertices.size());
  for (const Ring* ring : rings) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const std::uint32_t before = (*ring)[(i + ring->size() - 1) % ring->size()];
      const std::uint32_t next = (*ring)[(i + 1) % ring->size()];
      Corner& here = corners[(*ring)[i]];
      if (here.a == no_vertex) {
        here.a = before, here.b = next;
      } else if (std::minmax(here.a, here.b) != std::minmax(before, next)) {
        here.kept = true;
      }
    }
  }
  std::vector<bool> straight(vertices.size(), false);
  for (std::uint32_t v = 0; v < corners.size(); ++v) {
    const Corner& here = corners[v];
    if (here.kept || here.a == no_vertex || here.a == here.b) continue;
    const double off = here.off + off_chord(vertices[here.a], vertices[v], vertices[here.b]);
    if (!(off <= tolerance)) continue;
    straight[v] = true;
    for (const auto& [end, other] : {std::pair{here.a, here.b}, std::pair{here.b, here.a}}) {
      Corner& beside = corners[end];
      (beside.a == v ? beside.a : beside.b) = other;
      beside.off = std::max(beside.off, off);
    }
  }
  return straight;
}

}  // namespace atrium::layout
