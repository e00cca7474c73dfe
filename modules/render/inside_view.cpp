#include "modules/render/inside_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "modules/geometry/quantile.hpp"

namespace atrium::render {
namespace {

constexpr int directions = 48;
constexpr double reach = 15;  // metres that count of a line of sight

std::vector<float> along(const std::vector<Eigen::Vector3f>& points, int axis) {
  std::vector<float> values(points.size());
  std::transform(points.begin(), points.end(), values.begin(), [axis](const auto& p) { return p[axis]; });
  return values;
}

/// The lowest height at which much lies: in a histogram of 5 cm, the first peak of a third of the highest one. Nothing
/// if that is in the upper half: the scan has no floor.
std::optional<double> floor_height(const std::vector<Eigen::Vector3f>& points, double low, double high) {
  constexpr double step = 0.05;
  const auto bins = static_cast<std::size_t>(std::min((high - low) / step, 1e5)) + 3;
  std::vector<std::size_t> count(bins, 0);
  for (const auto& p : points)
    if (p.z() >= low && p.z() <= high) ++count[std::min(static_cast<std::size_t>((p.z() - low) / step) + 1, bins - 2)];
  const std::size_t most = *std::max_element(count.begin(), count.end());
  for (std::size_t i = 1; i + 1 < bins; ++i) {
    if (3 * count[i] < most || count[i] < count[i + 1]) continue;
    const double height = low + (static_cast<double>(i) - 0.5) * step;
    return height <= (low + high) / 2 ? std::optional(height) : std::nullopt;
  }
  return std::nullopt;
}

/// A map of one storey from above.
struct Plan {
  double left = 0, front = 0, cell = 0.1;
  int width = 1, depth = 1;
  std::vector<char> floor;
  std::vector<char> obstacle;  ///< something at eye height
  std::vector<int> clearance;  ///< cells to the nearest obstacle, or the border
  std::vector<int> beside;     ///< the same to the nearest thing from the height of a table up

  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < depth; }
  Eigen::Vector2d centre(int x, int y) const { return {left + (x + 0.5) * cell, front + (y + 0.5) * cell}; }
};

std::vector<char> grown(const Plan& plan, const std::vector<char>& cells, int by) {
  std::vector<char> result(cells.size(), 0);
  for (int y = 0; y < plan.depth; ++y)
    for (int x = 0; x < plan.width; ++x)
      if (cells[plan.at(x, y)] != 0)
        for (int v = std::max(0, y - by); v <= std::min(plan.depth - 1, y + by); ++v)
          for (int u = std::max(0, x - by); u <= std::min(plan.width - 1, x + by); ++u) result[plan.at(u, v)] = 1;
  return result;
}

/// Steps to the nearest obstacle or border, in two sweeps (chessboard distance).
std::vector<int> clearances(const Plan& plan, const std::vector<char>& things) {
  std::vector<int> steps(things.size(), 0);
  const auto neighbour = [&](int x, int y) { return plan.inside(x, y) ? steps[plan.at(x, y)] : 0; };
  for (int y = 0; y < plan.depth; ++y)
    for (int x = 0; x < plan.width; ++x)
      if (things[plan.at(x, y)] == 0)
        steps[plan.at(x, y)] =
            1 + std::min({neighbour(x - 1, y), neighbour(x - 1, y - 1), neighbour(x, y - 1), neighbour(x + 1, y - 1)});
  for (int y = plan.depth - 1; y >= 0; --y)
    for (int x = plan.width - 1; x >= 0; --x)
      steps[plan.at(x, y)] = std::min(
          steps[plan.at(x, y)],
          1 + std::min({neighbour(x + 1, y), neighbour(x + 1, y + 1), neighbour(x, y + 1), neighbour(x - 1, y + 1)}));
  return steps;
}

Plan plan_of(const std::vector<Eigen::Vector3f>& points, const std::optional<double>& floor, double eye) {
  Plan plan;
  const auto xs = along(points, 0);
  const auto ys = along(points, 1);
  plan.left = quantile(xs, 0.001) - 0.2;
  plan.front = quantile(ys, 0.001) - 0.2;
  const double across = quantile(xs, 0.999) + 0.2 - plan.left;
  const double deep = quantile(ys, 0.999) + 0.2 - plan.front;
  plan.cell = std::max(0.1, std::max(across, deep) / 800);
  plan.width = static_cast<int>(across / plan.cell) + 1;
  plan.depth = static_cast<int>(deep / plan.cell) + 1;
  const std::size_t cells = static_cast<std::size_t>(plan.width) * static_cast<std::size_t>(plan.depth);
  std::vector<char> seen_floor(cells, 0);
  std::vector<char> hits(cells, 0);
  std::vector<char> things(cells, 0);
  for (const auto& p : points) {
    const int x = static_cast<int>(std::floor((p.x() - plan.left) / plan.cell));
    const int y = static_cast<int>(std::floor((p.y() - plan.front) / plan.cell));
    if (!plan.inside(x, y)) continue;
    const std::size_t cell = plan.at(x, y);
    // Without a floor, what is under the ceiling is in the room.
    if (floor ? std::abs(p.z() - *floor) < 0.15 : p.z() > eye + 0.4) seen_floor[cell] = 1;
    if (std::abs(p.z() - eye) < 0.4 && hits[cell] < 2) ++hits[cell];
    if (p.z() > eye - 0.95 && p.z() < eye + 0.4 && things[cell] < 2) ++things[cell];
  }
  for (auto* some : {&hits, &things})
    for (auto& hit : *some) hit = hit >= 2 ? 1 : 0;  // one alone may be noise
  plan.floor = grown(plan, seen_floor, 3);
  plan.obstacle = grown(plan, hits, 1);
  plan.clearance = clearances(plan, plan.obstacle);
  plan.beside = clearances(plan, things);
  return plan;
}

/// Metres of floor along each direction, up to what stands in the way.
std::array<double, directions> sight_from(const Plan& plan, int x, int y) {
  std::array<double, directions> sight{};
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * std::numbers::pi * d / directions;
    for (int step = 1; step * plan.cell < reach; ++step) {
      const int u = x + static_cast<int>(std::lround(step * std::cos(angle)));
      const int v = y + static_cast<int>(std::lround(step * std::sin(angle)));
      if (!plan.inside(u, v) || plan.obstacle[plan.at(u, v)] != 0) break;
      if (plan.floor[plan.at(u, v)] != 0) sight[static_cast<std::size_t>(d)] += plan.cell;
    }
  }
  return sight;
}

struct Choice {
  double score = -1;
  int x = 0, y = 0, direction = 0;
};

Choice best_place(const Plan& plan) {
  int most = 0;
  for (std::size_t i = 0; i < plan.floor.size(); ++i)
    if (plan.floor[i] != 0) most = std::max(most, plan.clearance[i]);
  const int least = std::max(1, std::min(static_cast<int>(0.7 / plan.cell), 2 * most / 3));
  const int stride = std::max(2, static_cast<int>(std::sqrt(plan.floor.size() / 4000.0)));
  Choice best;
  for (int y = 0; y < plan.depth; y += stride)
    for (int x = 0; x < plan.width; x += stride) {
      const std::size_t cell = plan.at(x, y);
      if (plan.floor[cell] == 0 || plan.clearance[cell] < least || 3 * plan.beside[cell] < 2 * least) continue;
      const auto sight = sight_from(plan, x, y);
      for (int d = 0; d < directions; ++d) {
        double score = 0;
        for (int off = -5; off <= 5; ++off) {  // a field of view of about 75 degrees
          const double length = sight[static_cast<std::size_t>((d + off + directions) % directions)];
          score += length * length * (1 - 0.08 * std::abs(off));  // the area of a slice of floor
        }
        if (score > best.score) best = {score, x, y, d};
      }
    }
  return best;
}

}  // namespace

Viewpoint inside_view(const std::vector<Eigen::Vector3f>& surface) {
  const auto heights = along(surface, 2);
  const double low = quantile(heights, 0.001);
  const double high = quantile(heights, 0.999);
  const std::optional<double> found = floor_height(surface, low, high);
  const double floor = found.value_or(low);
  const double eye = std::min(floor + 1.6, std::max(floor + 0.6 * (high - floor), floor + 0.1));
  const Plan plan = plan_of(surface, found, eye);
  const Choice best = best_place(plan);
  if (best.score < 0) {
    const Eigen::Vector2d middle = plan.centre(plan.width / 2, plan.depth / 2);
    return {{middle.x(), middle.y(), eye}, {middle.x() + 1, middle.y() + 1, eye}};
  }
  const Eigen::Vector2d place = plan.centre(best.x, best.y);
  const double angle = 2 * std::numbers::pi * best.direction / directions;
  constexpr double down = 0.12;  // the floor is worth more of the picture than the ceiling
  return {{place.x(), place.y(), eye}, {place.x() + std::cos(angle), place.y() + std::sin(angle), eye - down}};
}

}  // namespace atrium::render
