#include "modules/geometry/triangulate.hpp"

#include <algorithm>
#include <map>

namespace atrium {
namespace {

struct Edge {
  Eigen::Vector2d low, high;
  double at(double y) const {
    if (y == low.y()) return low.x();
    if (y == high.y()) return high.x();
    return low.x() + (high.x() - low.x()) * ((y - low.y()) / (high.y() - low.y()));
  }
};
struct Trapezoid {
  std::size_t band;
  double bottom_left, bottom_right, top_left, top_right;
};

std::vector<Edge> edges_of(const std::vector<std::vector<Eigen::Vector2d>>& rings) {
  std::vector<Edge> edges;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (a.y() != b.y()) edges.push_back(a.y() < b.y() ? Edge{a, b} : Edge{b, a});
    }
  return edges;
}

std::vector<Trapezoid> trapezoids_of(const std::vector<Edge>& edges, const std::vector<double>& heights) {
  std::vector<Trapezoid> result;
  for (std::size_t band = 0; band + 1 < heights.size(); ++band) {
    const double bottom = heights[band], top = heights[band + 1], middle = (bottom + top) / 2;
    std::vector<const Edge*> crossing;
    for (const auto& e : edges)
      if (e.low.y() <= bottom && e.high.y() >= top) crossing.push_back(&e);
    std::sort(crossing.begin(), crossing.end(),
              [&](const Edge* a, const Edge* b) { return a->at(middle) < b->at(middle); });
    for (std::size_t i = 0; i + 1 < crossing.size(); i += 2) {
      const Edge &a = *crossing[i], &b = *crossing[i + 1];  // rings that cross change sides within a band
      const auto [bottom_left, bottom_right] = std::minmax({a.at(bottom), b.at(bottom)});
      const auto [top_left, top_right] = std::minmax({a.at(top), b.at(top)});
      result.push_back({band, bottom_left, bottom_right, top_left, top_right});
    }
  }
  return result;
}

}  // namespace

PlaneTriangles triangulate(const std::vector<std::vector<Eigen::Vector2d>>& rings) {
  std::vector<double> heights;
  for (const auto& ring : rings)
    for (const auto& p : ring) heights.push_back(p.y());
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  const auto trapezoids = trapezoids_of(edges_of(rings), heights);

  // Every corner on the line between two bands is a corner of the pieces on both sides.
  PlaneTriangles result;
  std::vector<std::map<double, std::uint32_t>> lines(heights.size());
  const auto add = [&](std::size_t line, double x) {
    const auto [place, added] = lines[line].emplace(x, static_cast<std::uint32_t>(result.points.size()));
    if (added) result.points.emplace_back(x, heights[line]);
  };
  for (const auto& t : trapezoids) {
    add(t.band, t.bottom_left);
    add(t.band, t.bottom_right);
    add(t.band + 1, t.top_left);
    add(t.band + 1, t.top_right);
  }
  const auto chain = [&](std::size_t line, double left, double right) {
    std::vector<std::uint32_t> points;
    for (auto i = lines[line].find(left); i != lines[line].end() && i->first <= right; ++i) points.push_back(i->second);
    return points;
  };
  for (const auto& t : trapezoids) {
    const auto low = chain(t.band, t.bottom_left, t.bottom_right);
    const auto high = chain(t.band + 1, t.top_left, t.top_right);
    std::size_t i = 0, k = 0;
    while (i + 1 < low.size() || k + 1 < high.size()) {
      const bool along_low = k + 1 == high.size() ||
                             (i + 1 < low.size() && result.points[low[i + 1]].x() <= result.points[high[k + 1]].x());
      if (along_low) {
        result.triangles.push_back({low[i], low[i + 1], high[k]});
        ++i;
      } else {
        result.triangles.push_back({low[i], high[k + 1], high[k]});
        ++k;
      }
    }
  }
  return result;
}

}  // namespace atrium
