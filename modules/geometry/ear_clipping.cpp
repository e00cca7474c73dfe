#include "modules/geometry/ear_clipping.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace atrium {
namespace {

using Eigen::Vector2d;
using Ring = std::vector<std::uint32_t>;  // indices of corners

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

class Clipper {
 public:
  explicit Clipper(const PlanPolygon& polygon) {
    add(polygon.outline);
    for (const auto& hole : polygon.holes) add(hole);
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

  // Whether the insides of a-b and of the rings' edges meet; edges that end in a or b do not count.
  bool crosses(std::uint32_t a, std::uint32_t b) const {
    for (const auto& ring : rings_)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2d &c = points_[ring[i]], &d = points_[ring[(i + 1) % ring.size()]];
        const Vector2d &p = points_[a], &q = points_[b];
        if (c == p || c == q || d == p || d == q) continue;
        if (turn(p, q, c) * turn(p, q, d) <= 0 && turn(c, d, p) * turn(c, d, q) <= 0) return true;
      }
    return false;
  }

  void join_nearest_hole() {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best_hole = 1, at_outline = 0, at_hole = 0;
    for (std::size_t h = 1; h < rings_.size(); ++h)
      for (std::size_t i = 0; i < rings_[0].size(); ++i)
        for (std::size_t k = 0; k < rings_[h].size(); ++k) {
          const double length = (points_[rings_[0][i]] - points_[rings_[h][k]]).squaredNorm();
          if (length >= least || crosses(rings_[0][i], rings_[h][k])) continue;
          least = length;
          best_hole = h;
          at_outline = i;
          at_hole = k;
        }
    Ring hole = std::move(rings_[best_hole]);
    rings_.erase(rings_.begin() + static_cast<std::ptrdiff_t>(best_hole));
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(at_hole), hole.end());
    hole.push_back(hole.front());
    hole.push_back(rings_[0][at_outline]);
    rings_[0].insert(rings_[0].begin() + static_cast<std::ptrdiff_t>(at_outline) + 1, hole.begin(), hole.end());
  }

  bool is_ear(const Ring& ring, std::size_t i) const {
    const std::size_t n = ring.size();
    const Vector2d &a = points_[ring[(i + n - 1) % n]], &b = points_[ring[i]], &c = points_[ring[(i + 1) % n]];
    // Corners on a line within rounding are no ear: their triangle would have no area.
    if (turn(a, b, c) <= 1e-12 * ((b - a).squaredNorm() + (c - b).squaredNorm())) return false;
    for (const auto k : ring) {
      const Vector2d& p = points_[k];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::vector<std::array<std::uint32_t, 3>> ears(Ring ring) const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t i = 0, passed = 0;
    while (ring.size() > 2) {
      const std::size_t n = ring.size();
      i %= n;
      // Where rounding leaves no ear, any corner does: nothing is left open.
      if (!is_ear(ring, i) && passed < n) {
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
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clip_ears(const PlanPolygon& polygon) {
  if (polygon.outline.size() < 3) return {};
  return Clipper(polygon).run();
}

}  // namespace atrium
