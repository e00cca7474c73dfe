#include "modules/geometry/ear_clipping.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace atrium {
namespace {

using Eigen::Vector2d;
using Ring = std::vector<std::uint32_t>;  // indices of corners

double side_of(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

class Clipper {
 public:
  explicit Clipper(const PlanPolygon& polygon) {
    add(polygon.outline);
    for (const auto& hole : polygon.holes)
      if (!hole.empty()) add(hole);
    Eigen::AlignedBox2d box;
    for (const auto& p : points_) box.extend(p);
    constexpr double rounding = 1e-10;
    flat_ = rounding * box.diagonal().norm();
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    while (rings_.size() > 1) join_nearest_hole();
    return ears(rings_.front());
  }

 private:
  void add(const PlanRing& ring) {
    Ring indices;
    for (const auto& p : ring) {
      indices.push_back(static_cast<std::uint32_t>(points_.size()));
      points_.push_back(p);
    }
    rings_.push_back(std::move(indices));
  }

  const Vector2d& place(const Ring& ring, std::size_t i) const { return points_[ring[i % ring.size()]]; }

  /// Whether the way from corner i of a ring to `to` begins inside of the polygon, as far as this corner tells.
  bool leads_inside(const Ring& ring, std::size_t i, const Vector2d& to) const {
    const Vector2d &before = place(ring, i + ring.size() - 1), &at = place(ring, i), &after = place(ring, i + 1);
    const bool left_of_in = side_of(before, at, to) > 0;
    const bool left_of_out = side_of(at, after, to) > 0;
    return side_of(before, at, after) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  }

  /// Whether the way from p to q, corners of the outline and of `hole`, meets any other corner or side.
  bool is_blocked(const Vector2d& p, const Vector2d& q, std::size_t hole) const {
    const double length = (q - p).norm();
    for (std::size_t r = 0; r < rings_.size(); ++r)
      for (std::size_t i = 0; i < rings_[r].size(); ++i) {
        const Vector2d &c = place(rings_[r], i), &d = place(rings_[r], i + 1);
        // Another hole that touches one of these corners.
        if (r != 0 && r != hole &&
            ((c == p && !leads_inside(rings_[r], i, q)) || (c == q && !leads_inside(rings_[r], i, p))))
          return true;
        if (c == p || c == q) continue;
        const double along = (c - p).dot(q - p) / length;
        if (along > 0 && along < length && std::abs(side_of(p, q, c)) <= flat_ * length) return true;
        if (d == p || d == q) continue;
        if (side_of(p, q, c) * side_of(p, q, d) <= 0 && side_of(c, d, p) * side_of(c, d, q) <= 0) return true;
      }
    return false;
  }

  bool is_bridge(std::size_t i, std::size_t hole, std::size_t k) const {
    const Vector2d &p = place(rings_[0], i), &q = place(rings_[hole], k);
    const Ring& ring = rings_[hole];
    if (p == q)
      return leads_inside(rings_[0], i, place(ring, k + 1)) &&
             leads_inside(rings_[0], i, place(ring, k + ring.size() - 1));
    return leads_inside(rings_[0], i, q) && leads_inside(ring, k, p) && !is_blocked(p, q, hole);
  }

  void join_nearest_hole() {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best_hole = 1, at_outline = 0, at_hole = 0;
    for (std::size_t h = 1; h < rings_.size(); ++h)
      for (std::size_t i = 0; i < rings_[0].size(); ++i)
        for (std::size_t k = 0; k < rings_[h].size(); ++k) {
          const double length = (place(rings_[0], i) - place(rings_[h], k)).squaredNorm();
          if (length >= least || !is_bridge(i, h, k)) continue;
          least = length;
          best_hole = h;
          at_outline = i;
          at_hole = k;
        }
    Ring hole = std::move(rings_[best_hole]);
    rings_.erase(rings_.begin() + static_cast<std::ptrdiff_t>(best_hole));
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(at_hole), hole.end());
    if (least == 0)
      hole.erase(hole.begin());  // one corner for both: no bridge
    else
      hole.push_back(hole.front());
    hole.push_back(rings_[0][at_outline]);
    rings_[0].insert(rings_[0].begin() + static_cast<std::ptrdiff_t>(at_outline) + 1, hole.begin(), hole.end());
  }

  /// Whether p is left of a → b, or within rounding of it.
  bool is_beside(const Vector2d& a, const Vector2d& b, const Vector2d& p) const {
    return side_of(a, b, p) >= -flat_ * (b - a).norm();
  }

  bool is_ear(const Ring& ring, std::size_t i) const {
    const Vector2d &a = place(ring, i + ring.size() - 1), &b = place(ring, i), &c = place(ring, i + 1);
    // Corners on a line within rounding are no ear: their triangle would have no area.
    if (side_of(a, b, c) <= flat_ * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()})) return false;
    return std::none_of(ring.begin(), ring.end(), [&](std::uint32_t k) {
      const Vector2d& p = points_[k];
      return p != a && p != b && p != c && is_beside(a, b, p) && is_beside(b, c, p) && is_beside(c, a, p);
    });
  }

  std::vector<std::array<std::uint32_t, 3>> ears(Ring ring) const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t i = 0, passed = 0;
    while (ring.size() > 2) {
      const std::size_t n = ring.size();
      i %= n;
      // Where rounding leaves no ear, any corner does: nothing is left open.
      if (passed < n && !is_ear(ring, i)) {
        ++i;
        ++passed;
        continue;
      }
      triangles.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      passed = 0;
    }
    return triangles;
  }

  std::vector<Vector2d> points_;
  std::vector<Ring> rings_;  // the outline first
  double flat_ = 0;          // metres: corners this near to a line are on it
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clip_ears(const PlanPolygon& polygon) {
  if (polygon.outline.size() < 3) return {};
  return Clipper(polygon).run();
}

}  // namespace atrium
