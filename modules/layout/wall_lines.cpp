#include "modules/layout/wall_lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "modules/geometry/quantile.hpp"

namespace atrium::layout {
namespace {

/// The lowest and the highest row that are about as full as others: stray points do not make a wall higher.
std::pair<int, int> full_rows(std::vector<std::pair<int, int>> rows) {
  constexpr double full = 0.4;
  std::vector<int> counts;
  counts.reserve(rows.size());
  for (const auto& row : rows) counts.push_back(row.first);
  const double least = full * median(std::move(counts));
  std::erase_if(rows, [&](const auto& row) { return row.first < least; });
  return {rows.front().second, rows.back().second};
}

void mark(const Raster& r, const Arrangement::Line& line, double step, int side, std::map<int, int>& seen) {
  constexpr double beside = 0.4;
  const Eigen::Vector2d along = line.along();
  for (int y = 0; y < r.height; ++y)
    for (int x = 0; x < r.width; ++x) {
      if (!r.at(x, y)) continue;
      const Eigen::Vector2d p = r.centre(x, y);
      if (std::abs(line.side(p)) <= beside) seen[static_cast<int>(std::floor(along.dot(p) / step))] |= side;
    }
}

std::optional<WallLine> meeting_line(const CellSurface& a, const CellSurface& b,
                                     const std::vector<Footprint>& footprints) {
  constexpr double least_slope = 0.05, step = 0.1, least_length = 0.3;
  const auto gradient = [](const CellSurface& s) -> Eigen::Vector2d {
    return -s.plane.normal.head<2>() / s.plane.normal.z();
  };
  const Eigen::Vector2d slope = gradient(a) - gradient(b);
  if (slope.norm() < least_slope) return {};
  WallLine meeting;
  meeting.line.normal = slope.normalized();
  meeting.line.offset = (b.plane.offset / b.plane.normal.z() - a.plane.offset / a.plane.normal.z()) / slope.norm();
  std::map<int, int> seen;  // along the line: 1 by a, 2 by b
  for (const auto p : primitives_of(a))
    mark(footprints[static_cast<std::size_t>(p)].raster, meeting.line, step, 1, seen);
  for (const auto p : primitives_of(b))
    mark(footprints[static_cast<std::size_t>(p)].raster, meeting.line, step, 2, seen);
  int both = 0, first = 0, last = 0;
  for (const auto& [place, sides] : seen) {
    if (sides != 3) continue;
    if (both++ == 0) first = place;
    last = place;
  }
  if (both * step < least_length) return {};
  meeting.begin = first * step;
  meeting.end = (last + 1) * step;
  return meeting;
}

}  // namespace

std::vector<std::int32_t> primitives_of(const CellSurface& surface) {
  std::vector<std::int32_t> result = surface.joined;
  if (surface.primitive >= 0) result.insert(result.begin(), surface.primitive);
  return result;
}

std::optional<WallLine> wall_line(const PlanePrimitives& planes, std::size_t primitive, const Footprint& footprint,
                                  double bottom, double top) {
  constexpr double least_height = 0.3;
  const Raster& r = footprint.raster;
  if (!footprint.upright || r.empty()) return {};
  bottom = std::max(bottom, r.low.y());
  top = std::min(top, r.high().y());
  if (top - bottom < least_height) return {};
  int first = r.width, last = -1, squares = 0;
  std::vector<std::pair<int, int>> rows;  // and how many of their squares hold points
  for (int y = std::max(0, r.row(bottom)); y < std::min(r.height, r.row(top) + 1); ++y) {
    int count = 0;
    for (int x = 0; x < r.width; ++x)
      if (r.at(x, y)) {
        first = std::min(first, x);
        last = std::max(last, x);
        ++count;
      }
    squares += count;
    if (count > 0) rows.emplace_back(count, y);
  }
  if (last < first) return {};
  WallLine wall;
  const Plane& plane = planes.primitives[primitive].plane;
  const double flat = plane.normal.head<2>().norm();
  wall.line.normal = plane.normal.head<2>() / flat;
  wall.line.offset = (plane.offset + plane.normal.z() * (bottom + top) / 2) / flat;
  wall.begin = r.low.x() + first * r.pixel;
  wall.end = r.low.x() + (last + 1) * r.pixel;
  const auto [foot, head] = full_rows(rows);
  wall.low = r.low.y() + (foot + 0.5) * r.pixel;
  wall.high = r.low.y() + (head + 0.5) * r.pixel;
  wall.area = squares * r.pixel * r.pixel;
  wall.primitives = {static_cast<std::int32_t>(primitive)};
  return wall;
}

void join_lines(std::vector<WallLine>& lines, double min_gap,
                const std::function<bool(const WallLine&, const WallLine&)>& apart) {
  constexpr double parallel = 0.98;
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  std::vector<WallLine> kept;
  for (auto& wall : lines) {
    const Eigen::Vector2d foot = -wall.line.offset * wall.line.normal;
    const Eigen::Vector2d a = foot + wall.begin * wall.line.along();
    const Eigen::Vector2d b = foot + wall.end * wall.line.along();
    const auto line = std::find_if(kept.begin(), kept.end(), [&](const WallLine& k) {
      return std::abs(k.line.normal.dot(wall.line.normal)) > parallel && std::abs(k.line.side(a)) <= min_gap &&
             std::abs(k.line.side(b)) <= min_gap && !apart(k, wall);
    });
    if (line == kept.end()) {
      kept.push_back(std::move(wall));
      continue;
    }
    const Eigen::Vector2d along = line->line.along();
    line->begin = std::min({line->begin, along.dot(a), along.dot(b)});
    line->end = std::max({line->end, along.dot(a), along.dot(b)});
    line->low = std::min(line->low, wall.low);
    line->high = std::max(line->high, wall.high);
    line->area += wall.area;
    line->primitives.push_back(wall.primitives.front());
  }
  lines = std::move(kept);
}

void join_surfaces(std::vector<CellSurface>& surfaces, const std::vector<Footprint>& footprints, double min_gap) {
  const auto raster = [&](const CellSurface& s) -> const Raster& {
    return footprints[static_cast<std::size_t>(s.primitive)].raster;
  };
  std::stable_sort(surfaces.begin(), surfaces.end(),
                   [&](const auto& a, const auto& b) { return raster(a).area() > raster(b).area(); });
  std::vector<CellSurface> kept;
  for (auto& surface : surfaces) {
    const Raster& r = raster(surface);
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const CellSurface& k) {
      const auto near = [&](const Eigen::Vector2d& p) {
        return std::abs(k.height_at(p) - surface.height_at(p)) <= min_gap;
      };
      const Eigen::Vector2d low = r.low, high = r.high();
      return near(low) && near(high) && near({low.x(), high.y()}) && near({high.x(), low.y()});
    });
    if (same == kept.end())
      kept.push_back(std::move(surface));
    else
      same->joined.push_back(surface.primitive);
  }
  surfaces = std::move(kept);
}

std::vector<WallLine> meeting_lines(const std::vector<CellSurface>& some, const std::vector<CellSurface>& others,
                                    const std::vector<Footprint>& footprints) {
  std::vector<WallLine> result;
  for (std::size_t i = 0; i < some.size(); ++i)
    for (std::size_t k = &some == &others ? i + 1 : 0; k < others.size(); ++k) {
      const CellSurface &a = some[i], &b = others[k];
      if (a.primitive < 0 || b.primitive < 0 || (is_level(a.plane) && is_level(b.plane))) continue;
      if (auto line = meeting_line(a, b, footprints)) result.push_back(std::move(*line));
    }
  return result;
}

}  // namespace atrium::layout
