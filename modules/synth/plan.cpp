#include "modules/synth/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrium::synth {
namespace {

Eigen::Vector2d turned(const Eigen::Vector2d& v, double yaw) {
  return {std::cos(yaw) * v.x() - std::sin(yaw) * v.y(), std::sin(yaw) * v.x() + std::cos(yaw) * v.y()};
}

double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const Eigen::Vector2d ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm();
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool segments_cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                    const Eigen::Vector2d& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

}  // namespace

Ring2 Footprint::corners() const {
  Ring2 ring;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    ring.push_back(centre + turned({x * half.x(), y * half.y()}, yaw));
  return ring;
}

double Footprint::distance(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d local = turned(p - centre, -yaw);
  return (local.cwiseAbs() - half).cwiseMax(0.0).norm();
}

bool overlap(const Footprint& a, const Footprint& b, double gap) {
  for (const auto& [frame, other] : {std::pair{&a, &b}, {&b, &a}}) {
    const Ring2 corners = other->corners();
    for (int axis = 0; axis < 2; ++axis) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const auto& c : corners) {
        const double x = turned(c - frame->centre, -frame->yaw)[axis];
        low = std::min(low, x);
        high = std::max(high, x);
      }
      if (low > frame->half[axis] + gap || high < -frame->half[axis] - gap) return false;
    }
  }
  return true;
}

bool inside(const Ring2& ring, const Eigen::Vector2d& p) {
  bool in = false;
  for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
    const auto &a = ring[i], &b = ring[k];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      in = !in;
  }
  return in;
}

bool inside(const Ring2& ring, const Footprint& footprint) {
  const Ring2 corners = footprint.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!inside(ring, corners[i])) return false;
    for (std::size_t k = 0; k < ring.size(); ++k)
      if (segments_cross(corners[i], corners[(i + 1) % 4], ring[k], ring[(k + 1) % ring.size()])) return false;
  }
  // A corner of the room may stick into the rectangle without crossing its sides only if it is a vertex inside it.
  return std::none_of(ring.begin(), ring.end(), [&](const auto& p) { return footprint.distance(p) == 0; });
}

double distance_to_border(const Ring2& ring, const Eigen::Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i)
    least = std::min(least, distance_to_segment(ring[i], ring[(i + 1) % ring.size()], p));
  return least;
}

Ring2 scanner_places(const Ring2& room, const std::vector<Footprint>& furniture, std::size_t count) {
  constexpr double raster = 0.2, wanted = 0.45;
  Eigen::Vector2d low = room.front(), high = room.front();
  for (const auto& p : room) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Ring2 candidates;
  std::vector<double> clearances;
  for (double y = low.y() + raster / 2; y < high.y(); y += raster)
    for (double x = low.x() + raster / 2; x < high.x(); x += raster) {
      const Eigen::Vector2d p(x, y);
      if (!inside(room, p)) continue;
      double clearance = distance_to_border(room, p);
      for (const auto& f : furniture) clearance = std::min(clearance, f.distance(p));
      candidates.push_back(p);
      clearances.push_back(clearance);
    }
  Ring2 places;
  while (places.size() < count && !candidates.empty()) {
    double best = -1;
    std::size_t at = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      double score = clearances[i];
      if (!places.empty()) {
        if (score < wanted) continue;
        score = std::numeric_limits<double>::infinity();
        for (const auto& p : places) score = std::min(score, (p - candidates[i]).norm());
        if (score < wanted) continue;
      }
      if (score > best) {
        best = score;
        at = i;
      }
    }
    if (best < 0) break;
    places.push_back(candidates[at]);
  }
  return places;
}

}  // namespace atrium::synth
