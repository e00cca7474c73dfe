#include "modules/synth/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

// Without their last digits, so that corners which mirror each other stand at exactly one height.
Eigen::Vector2d rounded(const Eigen::Vector2d& p) {
  constexpr double step = 1e-12;
  return {std::round(p.x() / step) * step, std::round(p.y() / step) * step};
}

struct Candidates {
  Ring2 places;
  std::vector<double> clearances;
};

Candidates candidates_in(const Ring2& room, const std::vector<Footprint>& furniture) {
  constexpr double raster = 0.2;
  Eigen::Vector2d low = room.front(), high = room.front();
  for (const auto& p : room) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Candidates result;
  for (double y = low.y() + raster / 2; y < high.y(); y += raster)
    for (double x = low.x() + raster / 2; x < high.x(); x += raster) {
      const Eigen::Vector2d p(x, y);
      if (!inside(room, p)) continue;
      double clearance = distance_to_border(room, p);
      for (const auto& f : furniture) clearance = std::min(clearance, f.distance(p));
      result.places.push_back(p);
      result.clearances.push_back(clearance);
    }
  return result;
}

// The parts of a room's outline, some 0.2 m each, that no place sees yet.
class Unseen {
 public:
  explicit Unseen(const Ring2& room) : room_(room) {
    for (std::size_t i = 0; i < room.size(); ++i) {
      const Eigen::Vector2d &a = room[i], &b = room[(i + 1) % room.size()];
      const int parts = std::max(1, static_cast<int>((b - a).norm() / 0.2));
      for (int k = 0; k < parts; ++k) parts_.push_back({i, a + (b - a) * ((k + 0.5) / parts)});
    }
  }
  std::vector<std::size_t> seen_from(const Eigen::Vector2d& place) const {
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (sees(place, parts_[i])) seen.push_back(i);
    return seen;
  }
  void remove(const Eigen::Vector2d& place) {
    const auto seen = seen_from(place);
    for (auto i = seen.rbegin(); i != seen.rend(); ++i) parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(*i));
  }

 private:
  struct Part {
    std::size_t side;
    Eigen::Vector2d middle;
  };
  bool sees(const Eigen::Vector2d& place, const Part& part) const {
    for (std::size_t i = 0; i < room_.size(); ++i) {
      const Eigen::Vector2d &a = room_[i], &b = room_[(i + 1) % room_.size()];
      if (i == part.side ? cross(b - a, place - a) <= 0 : segments_cross(place, part.middle, a, b)) return false;
    }
    return true;
  }
  const Ring2& room_;
  std::vector<Part> parts_;
};

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

Ring2 inset(const Ring2& ring, const std::vector<double>& by) {
  const std::size_t n = ring.size();
  const auto along = [&](std::size_t i) { return Eigen::Vector2d((ring[(i + 1) % n] - ring[i]).normalized()); };
  Ring2 result;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const Eigen::Vector2d d = along(before), e = along(i);
    const Eigen::Vector2d p = ring[i] + by[before] * Eigen::Vector2d(-d.y(), d.x()),
                          q = ring[i] + by[i] * Eigen::Vector2d(-e.y(), e.x());
    result.push_back(rounded(p + d * (cross(q - p, e) / cross(d, e))));
  }
  return result;
}

void set_back(Ring2& ring, std::size_t side, double from, double to, double depth) {
  const Eigen::Vector2d a = ring[side], along = (ring[(side + 1) % ring.size()] - a).normalized(),
                        inwards = depth * Eigen::Vector2d(-along.y(), along.x());
  const Ring2 corners{a + from * along, a + from * along + inwards, a + to * along + inwards, a + to * along};
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(side) + 1, corners.begin(), corners.end());
}

Ring2 regular_polygon(const Eigen::Vector2d& centre, double radius, int corners) {
  Ring2 ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    ring.push_back(rounded(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle))));
  }
  return ring;
}

Ring2 scanner_places(const Ring2& room, const std::vector<Footprint>& furniture, std::size_t count) {
  constexpr double apart = 0.45;
  double wanted = apart;  // room around a tripod
  const Candidates candidates = candidates_in(room, furniture);
  Unseen unseen(room);
  Ring2 places;
  while (places.size() < count && !candidates.places.empty()) {
    std::pair<std::size_t, double> best{0, -1};  // what of the outline it sees anew, and how far it is from the others
    std::size_t at = 0;
    for (std::size_t i = 0; i < candidates.places.size(); ++i) {
      std::pair<std::size_t, double> score{0, candidates.clearances[i]};
      if (!places.empty()) {
        if (score.second < wanted) continue;
        score = {unseen.seen_from(candidates.places[i]).size(), std::numeric_limits<double>::infinity()};
        for (const auto& p : places) score.second = std::min(score.second, (p - candidates.places[i]).norm());
        if (score.second < apart) continue;
      }
      if (score > best) {
        best = score;
        at = i;
      }
    }
    if (best.second < 0 && places.size() < 2 && wanted == apart) {
      wanted = 0.25;  // a crowded room: where a tripod just stands
      continue;
    }
    if (best.second < 0) break;
    places.push_back(candidates.places[at]);
    unseen.remove(places.back());
  }
  return places;
}

}  // namespace atrium::synth
