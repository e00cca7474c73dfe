#include "modules/layout/face_rings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace atrium::layout {
namespace {

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

}  // namespace atrium::layout
