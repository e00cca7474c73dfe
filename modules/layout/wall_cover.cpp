#include "modules/layout/wall_cover.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/coverage.hpp"

namespace atrium::layout {
namespace {

constexpr double enough_seen = 0.1;  // of a cell

/// The place of the first ceiling over a prism that was seen, or else of the first; not past a floor that was seen.
template <class LooksUp>
std::size_t seen_ceiling(const PrismStack& stack, std::size_t prism, LooksUp looks_up) {
  std::size_t hidden = stack.surfaces.size();
  for (std::size_t k = prism; k < stack.surfaces.size(); ++k) {
    const bool seen = stack.cover[k] >= enough_seen;
    if (looks_up(k) && seen) break;
    if (!looks_up(k) && seen) return k;
    if (!looks_up(k)) hidden = std::min(hidden, k);
  }
  return hidden < stack.surfaces.size() ? hidden : prism;
}

/// The place of the first floor under a prism that was seen, not past a ceiling that was seen; or else of what it
/// stands on.
template <class LooksUp>
std::size_t seen_floor(const PrismStack& stack, std::size_t prism, LooksUp looks_up) {
  for (std::size_t k = prism; k > 0; --k) {
    const bool seen = stack.cover[k - 1] >= enough_seen;
    if (looks_up(k - 1) && seen) return k - 1;
    if (!looks_up(k - 1) && seen) break;
  }
  return prism - 1;
}

}  // namespace

WallCover::WallCover(const PrismSpace& space, const PlanePrimitives& planes, const std::vector<Footprint>& footprints)
    : space_(space), planes_(planes), footprints_(footprints), known_(space.plan.edges.size()) {}

double WallCover::operator()(std::size_t edge, std::size_t side, std::size_t prism) {
  constexpr double same = 0.01;  // metres
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
  const std::size_t top = seen_ceiling(stack, prism, looks_up), bottom = seen_floor(stack, prism, looks_up);
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
