#include "modules/layout/wall_cover.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/coverage.hpp"

namespace atrium::layout {

WallCover::WallCover(const PrismSpace& space, const PlanePrimitives& planes, const std::vector<Footprint>& footprints)
    : space_(space), planes_(planes), footprints_(footprints), known_(space.plan.edges.size()) {}

double WallCover::operator()(std::size_t edge, std::size_t side, std::size_t prism) {
  constexpr double enough = 0.1, same = 0.01;
  const CellEdge& e = space_.plan.edges[edge];
  const std::int32_t front = side == 0 ? e.left : e.right;
  if (front < 0 || e.line < 0 || space_.plan.lines[static_cast<std::size_t>(e.line)].primitives.empty()) return 0;
  const PrismStack& stack = space_.stacks[static_cast<std::size_t>(front)];
  if (prism == 0 || prism >= stack.surfaces.size()) return 0;
  const Eigen::Vector2d middle = (space_.plan.vertices[e.from] + space_.plan.vertices[e.to]) / 2;
  const auto looks_up = [&](std::size_t k) { return space_.surfaces[static_cast<std::size_t>(stack.surfaces[k])].up; };
  // Within a slab no wall looks at anything.
  constexpr double mostly = 0.5;
  const bool over_ceiling = !looks_up(prism - 1) && stack.cover[prism - 1] >= mostly;
  if (over_ceiling || (looks_up(prism) && stack.cover[prism] >= mostly)) return 0;
  // Up to the first ceiling that was seen, or else the first; not past a floor that was seen. And so down.
  const std::size_t none = stack.surfaces.size();
  std::size_t top = none, bottom = none, hidden_top = none;
  for (std::size_t k = prism; k < none && top == none; ++k) {
    const bool seen = stack.cover[k] >= enough;
    if (looks_up(k) && seen) break;
    if (!looks_up(k) && seen) top = k;
    if (!looks_up(k) && hidden_top == none) hidden_top = k;
  }
  if (top == none) top = hidden_top != none ? hidden_top : prism;
  for (std::size_t k = prism; k > 0 && bottom == none; --k) {
    const bool seen = stack.cover[k - 1] >= enough;
    if (!looks_up(k - 1) && seen) break;
    if (looks_up(k - 1) && seen) bottom = k - 1;
  }
  if (bottom == none) bottom = prism - 1;
  const double floor = space_.height(stack.surfaces[bottom], middle);
  const double ceiling = space_.height(stack.surfaces[top], middle);
  auto& known = known_[edge][side];
  for (const auto& k : known)
    if (std::abs(k.ceiling - ceiling) < same && std::abs(k.floor - floor) < same) return k.share;
  known.push_back({floor, ceiling, measure(e, side, floor, ceiling)});
  return known.back().share;
}

double WallCover::measure(const CellEdge& edge, std::size_t side, double floor, double ceiling) const {
  constexpr double head = 1.8;  // metres: walls that begin higher are sides of beams, they end no room
  const CellLine& line = space_.plan.lines[static_cast<std::size_t>(edge.line)];
  const Eigen::Vector2d& a = space_.plan.vertices[edge.from];
  const Eigen::Vector2d& b = space_.plan.vertices[edge.to];
  const Eigen::Vector2d left(a.y() - b.y(), b.x() - a.x());
  const int samples = std::max(1, static_cast<int>(std::ceil((b - a).norm() / space_.pixel)));
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d p = a + (b - a) * ((i + 0.5) / samples);
    double seen = 0;
    for (const auto primitive : line.primitives) {
      const auto index = static_cast<std::size_t>(primitive);
      const bool looks_left = planes_.primitives[index].plane.normal.head<2>().dot(left) > 0;
      if (looks_left != (side == 0) || footprints_[index].raster.low.y() > floor + head) continue;
      seen = std::max(seen, wall_reach(footprints_[index], p, floor, ceiling));
    }
    sum += seen;
  }
  return sum / samples;
}

}  // namespace atrium::layout
