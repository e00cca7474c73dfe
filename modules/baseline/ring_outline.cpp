#include "modules/baseline/ring_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/plan_overlay.hpp"
#include "modules/geometry/quantile.hpp"

namespace atrium::baseline {
namespace {

using Eigen::Vector2d;

struct OutlineSide {
  Vector2d from, to;       // of the simplified ring
  Vector2d along, inward;  // unit length
  double offset = 0;       // inward · x
  double length() const { return (to - from).norm(); }
};

double distance_to(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

void split(const PlanRing& ring, std::size_t first, std::size_t last, double tolerance, std::vector<char>& stays) {
  double most = tolerance;
  std::size_t furthest = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double d = distance_to(ring[i], ring[first], ring[last % ring.size()]);
    if (d > most) {
      most = d;
      furthest = i;
    }
  }
  if (furthest == first) return;
  stays[furthest] = 1;
  split(ring, first, furthest, tolerance, stays);
  split(ring, furthest, last, tolerance, stays);
}

void turn_to(OutlineSide& side, double direction, double snap_angle) {
  constexpr double quarter = std::numbers::pi / 2;
  const double angle = std::atan2(side.along.y(), side.along.x());
  const double snapped = direction + quarter * std::round((angle - direction) / quarter);
  if (std::abs(angle - snapped) > snap_angle * std::numbers::pi / 180) return;
  side.along = {std::cos(snapped), std::sin(snapped)};
  side.inward = {-side.along.y(), side.along.x()};
}

// Onto the wall: the median of the points before the side's middle part that look into the room.
void move_onto(OutlineSide& side, const WallPoints& walls, double reach) {
  constexpr std::size_t least = 20;
  constexpr double cosine = 0.8;
  constexpr double margin = 0.05;
  const double from = side.along.dot(side.from) + margin, to = side.along.dot(side.to) - margin;
  std::vector<double> offsets;
  for (std::size_t i = 0; i < walls.places.size(); ++i) {
    const double t = side.along.dot(walls.places[i]), d = side.inward.dot(walls.places[i]);
    if (t < from || t > to || std::abs(d - side.offset) > reach) continue;
    if (!walls.normals.empty() && walls.normals[i].dot(side.inward) < cosine) continue;
    offsets.push_back(d);
  }
  if (offsets.size() >= least) side.offset = median(std::move(offsets));
}

std::vector<OutlineSide> sides_of(const PlanRing& ring, double direction, const WallPoints& walls,
                                  const OutlineLimits& limits) {
  const auto corners = simplified(ring, limits.tolerance);
  std::vector<OutlineSide> sides;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t first = corners[k], last = corners[(k + 1) % corners.size()];
    OutlineSide side;
    side.from = ring[first];
    side.to = ring[last];
    side.along = (side.to - side.from).normalized();
    side.inward = {-side.along.y(), side.along.x()};
    if (limits.snap_angle > 0) turn_to(side, direction, limits.snap_angle);
    std::vector<double> offsets;
    for (std::size_t i = first; i != last; i = (i + 1) % ring.size()) offsets.push_back(side.inward.dot(ring[i]));
    side.offset = median(std::move(offsets));
    if (limits.reach > 0) move_onto(side, walls, limits.reach);
    sides.push_back(side);
  }
  return sides;
}

// Neighbouring sides on nearly the same line become the longer one.
void join_sides(std::vector<OutlineSide>& sides, double tolerance) {
  for (std::size_t i = 0; i < sides.size() && sides.size() > 3;) {
    const std::size_t next = (i + 1) % sides.size();
    const bool same =
        sides[i].along.dot(sides[next].along) > 0.98 && std::abs(sides[i].offset - sides[next].offset) < tolerance;
    if (!same) {
      ++i;
      continue;
    }
    OutlineSide joined = sides[i].length() >= sides[next].length() ? sides[i] : sides[next];
    joined.from = sides[i].from;
    joined.to = sides[next].to;
    sides[i] = joined;
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(next));
    if (next < i) --i;
  }
}

// Short sides across a corner, as the pixels of one leave them, go: their neighbours meet.
void drop_chamfers(std::vector<OutlineSide>& sides, double length) {
  constexpr double parallel = 0.95, square = 0.5;
  for (std::size_t i = 0; i < sides.size() && sides.size() > 3;) {
    const OutlineSide& before = sides[(i + sides.size() - 1) % sides.size()];
    const OutlineSide& after = sides[(i + 1) % sides.size()];
    const bool chamfer = sides[i].length() < length && std::abs(before.along.dot(after.along)) < square &&
                         std::abs(sides[i].along.dot(before.along)) < parallel &&
                         std::abs(sides[i].along.dot(after.along)) < parallel;
    if (chamfer)
      sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
}

PlanRing cut(const std::vector<OutlineSide>& sides) {
  PlanRing ring;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const OutlineSide &a = sides[k], &b = sides[(k + 1) % sides.size()];
    const double sine = a.inward.x() * b.inward.y() - a.inward.y() * b.inward.x();
    if (std::abs(sine) > 0.25) {
      ring.emplace_back((a.offset * b.inward.y() - b.offset * a.inward.y()) / sine,
                        (b.offset * a.inward.x() - a.offset * b.inward.x()) / sine);
      continue;
    }
    for (const OutlineSide* side : {&a, &b})  // a step between parallel sides
      ring.emplace_back(a.to + side->inward * (side->offset - side->inward.dot(a.to)));
  }
  return ring;
}

bool is_simple(const PlanRing& ring) {
  return ring.size() >= 3 && overlay::is_valid(overlay::corrected({ring, {}}));  // holes run the other way
}

}  // namespace

double main_direction(const std::vector<PlanRing>& rings) {
  Vector2d sum = Vector2d::Zero();
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2d d = ring[(i + 1) % ring.size()] - ring[i];
      const double angle = 4 * std::atan2(d.y(), d.x());
      sum += d.norm() * Vector2d(std::cos(angle), std::sin(angle));
    }
  const double angle = std::atan2(sum.y(), sum.x()) / 4;
  return angle < 0 ? angle + std::numbers::pi / 2 : angle;
}

double refined_direction(double direction, const WallPoints& walls) {
  constexpr double near = 0.17;  // about ten degrees
  Vector2d sum = Vector2d::Zero();
  for (const auto& n : walls.normals) {
    const double angle = 4 * (std::atan2(n.y(), n.x()) - direction);
    if (std::cos(angle) > std::cos(4 * near)) sum += Vector2d(std::cos(angle), std::sin(angle));
  }
  return sum.norm() > 0 ? direction + std::atan2(sum.y(), sum.x()) / 4 : direction;
}

std::vector<std::size_t> simplified(const PlanRing& ring, double tolerance) {
  std::vector<std::size_t> result;
  if (ring.size() < 3) return result;
  const auto furthest_from = [&](std::size_t from) {
    return static_cast<std::size_t>(std::max_element(ring.begin(), ring.end(),
                                                     [&](const Vector2d& a, const Vector2d& b) {
                                                       return (a - ring[from]).squaredNorm() <
                                                              (b - ring[from]).squaredNorm();
                                                     }) -
                                    ring.begin());
  };
  const std::size_t a = furthest_from(0), b = furthest_from(a);  // both are corners of the hull
  PlanRing turned(ring);
  const std::size_t first = std::min(a, b), second = std::max(a, b) - first;
  std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
  std::vector<char> stays(ring.size(), 0);
  stays[0] = stays[second] = 1;
  split(turned, 0, second, tolerance, stays);
  split(turned, second, ring.size(), tolerance, stays);
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (stays[(i + ring.size() - first) % ring.size()]) result.push_back(i);
  return result;
}

PlanRing straight_outline(const PlanRing& ring, double direction, const WallPoints& walls,
                          const OutlineLimits& limits) {
  OutlineLimits coarser = limits;
  for (int attempt = 0; attempt < 3; ++attempt) {
    std::vector<OutlineSide> sides = sides_of(ring, direction, walls, coarser);
    join_sides(sides, coarser.tolerance);
    drop_chamfers(sides, 3 * coarser.tolerance);
    PlanRing result = cut(sides);
    if (is_simple(result)) return result;
    coarser.tolerance *= 1.5;
  }
  PlanRing result;
  for (const auto i : simplified(ring, limits.tolerance)) result.push_back(ring[i]);
  return result;
}

}  // namespace atrium::baseline
