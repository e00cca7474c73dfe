#include "modules/geometry/polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace atrium {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - b);
}
bool before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
}

/// Drops the points strictly inside the polygon of the extremes in eight directions: they are not on the hull (Akl and
/// Toussaint 1978). What is left of a scanned surface is a thin rim.
void drop_inner(std::vector<Eigen::Vector2d>& points) {
  static const std::array<Eigen::Vector2d, 8> directions{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<Eigen::Vector2d, 8> extremes;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    double best = -std::numeric_limits<double>::infinity();
    for (const auto& p : points) {
      const double height = directions[k].dot(p);
      if (height > best) {
        best = height;
        extremes[k] = p;
      }
    }
  }
  std::erase_if(points, [&](const Eigen::Vector2d& p) {
    for (std::size_t k = 0; k < extremes.size(); ++k) {
      const Eigen::Vector2d edge = extremes[(k + 1) % extremes.size()] - extremes[k];
      if (!edge.isZero() && cross(edge, p - extremes[k]) <= 0) return false;
    }
    return true;
  });
}

}  // namespace

double area(const Polygon2& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return twice / 2;
}

Eigen::Vector3d vector_area(const std::vector<Eigen::Vector3d>& corners) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i)
    twice += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  return twice / 2;
}

bool is_convex(const Polygon2& polygon, double tolerance) {
  const std::size_t n = polygon.size();
  if (n < 3 || area(polygon) <= 0) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& c = polygon[(i + 2) % n];
    if (turn(a, polygon[(i + 1) % n], c) < -tolerance * (c - a).norm()) return false;
  }
  return true;
}

Polygon2 convex_hull(std::vector<Eigen::Vector2d> points) {
  constexpr std::size_t worth_filtering = 64;
  if (points.size() > worth_filtering) drop_inner(points);
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon2 hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *it) <= 0) hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();  // the first of the other half
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return hull;
}

Polygon2 Rectangle2::corners() const {
  const Eigen::Vector2d p = perpendicular();
  return {axis * low.x() + p * low.y(), axis * high.x() + p * low.y(), axis * high.x() + p * high.y(),
          axis * low.x() + p * high.y()};
}

Rectangle2 minimum_area_rectangle(const Polygon2& hull) {
  const std::size_t n = hull.size();
  Rectangle2 best;
  double best_area = std::numeric_limits<double>::infinity();
  // The calipers: corners furthest along the edge, furthest from it and furthest back, each only ever advancing.
  std::size_t front = 0, top = 0, back = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Rectangle2 r;
    r.axis = (hull[(i + 1) % n] - hull[i]).normalized();
    const Eigen::Vector2d up = r.perpendicular();
    const auto advance = [&](std::size_t from, const Eigen::Vector2d& direction) {
      while (direction.dot(hull[(from + 1) % n] - hull[from]) > 0) from = (from + 1) % n;
      return from;
    };
    front = advance(i == 0 ? 1 % n : front, r.axis);
    top = advance(i == 0 ? front : top, up);
    back = advance(i == 0 ? top : back, -r.axis);
    r.low = {r.axis.dot(hull[back]), up.dot(hull[i])};
    r.high = {r.axis.dot(hull[front]), up.dot(hull[top])};
    const double size = (r.high - r.low).prod();
    if (size < best_area) {
      best_area = size;
      best = r;
    }
  }
  return best;
}

CutPolygon cut(const Polygon2& polygon, const Line2& line, double tolerance) {
  std::vector<double> sides(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    sides[i] = line.side(polygon[i]);
    if (std::abs(sides[i]) <= tolerance) sides[i] = 0;
  }
  CutPolygon result;
  if (std::all_of(sides.begin(), sides.end(), [](double s) { return s >= 0; })) return {polygon, {}};
  if (std::all_of(sides.begin(), sides.end(), [](double s) { return s <= 0; })) return {{}, polygon};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t j = (i + 1) % polygon.size();
    if (sides[i] >= 0) result.positive.push_back(polygon[i]);
    if (sides[i] <= 0) result.negative.push_back(polygon[i]);
    if (sides[i] * sides[j] < 0) {
      const Eigen::Vector2d crossing = polygon[i] + (polygon[j] - polygon[i]) * (sides[i] / (sides[i] - sides[j]));
      result.positive.push_back(crossing);
      result.negative.push_back(crossing);
    }
  }
  return result;
}

}  // namespace atrium
