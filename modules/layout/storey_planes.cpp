#include "modules/layout/storey_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "graph/api/error.hpp"
#include "modules/layout/end_lines.hpp"

namespace atrium::layout {
namespace {

constexpr double far = 1e9;

class Storey {
 public:
  Storey(const Structure& structure, const std::vector<Footprint>& footprints, std::int32_t index)
      : structure_(structure), footprints_(footprints), index_(index) {}

  StoreyPlanes run(double low, double high, double min_gap) {
    planes_.low = low;
    planes_.high = high;
    for (std::size_t i = 0; i < structure_.classes.size(); ++i) {
      const SurfaceClass c = structure_.classes[i];
      if (c == SurfaceClass::wall) add_wall(i);
      if (structure_.storeys[i] != index_ || footprints_[i].raster.empty()) continue;
      if (c == SurfaceClass::floor) planes_.floors.push_back(surface(i));
      if (c == SurfaceClass::ceiling) planes_.ceilings.push_back(surface(i));
    }
    join_surfaces(planes_.floors, min_gap);
    join_surfaces(planes_.ceilings, min_gap);
    settle_heights();
    join_lines(min_gap);
    auto ends = end_lines(planes_, footprints_);
    std::move(ends.begin(), ends.end(), std::back_inserter(planes_.lines));
    add_meeting_lines(planes_.ceilings, planes_.ceilings);
    add_meeting_lines(planes_.ceilings, planes_.floors);
    return std::move(planes_);
  }

 private:
  const Raster& raster(std::int32_t primitive) const { return footprints_[static_cast<std::size_t>(primitive)].raster; }
  CellSurface surface(std::size_t i) const {
    return {structure_.primitives->primitives[i].plane, static_cast<std::int32_t>(i), {}};
  }

  void add_wall(std::size_t i) {
    constexpr double least_height = 0.3;
    const Footprint& f = footprints_[i];
    if (!f.upright || f.raster.empty()) return;
    const double bottom = std::max(planes_.low, f.raster.low.y());
    const double top = std::min(planes_.high, f.raster.high().y());
    if (top - bottom < least_height) return;
    WallLine wall;
    int first = f.raster.width, last = -1, squares = 0;
    std::vector<std::pair<int, int>> rows;  // and how many of their squares hold points
    for (int y = std::max(0, f.raster.row(bottom)); y < std::min(f.raster.height, f.raster.row(top) + 1); ++y) {
      int count = 0;
      for (int x = 0; x < f.raster.width; ++x)
        if (f.raster.at(x, y)) {
          first = std::min(first, x);
          last = std::max(last, x);
          ++count;
        }
      squares += count;
      if (count > 0) rows.emplace_back(count, y);
    }
    if (last < first) return;
    const Plane& plane = structure_.primitives->primitives[i].plane;
    const double flat = plane.normal.head<2>().norm();
    wall.line.normal = plane.normal.head<2>() / flat;
    wall.line.offset = (plane.offset + plane.normal.z() * (bottom + top) / 2) / flat;
    wall.begin = f.raster.low.x() + first * f.raster.pixel;
    wall.end = f.raster.low.x() + (last + 1) * f.raster.pixel;
    wall.area = squares * f.raster.pixel * f.raster.pixel;
    wall.primitives = {static_cast<std::int32_t>(i)};
    const auto [foot, head] = ends_of(rows);
    tops_.emplace_back(f.raster.low.y() + (head + 0.5) * f.raster.pixel, wall.area);
    bottoms_.emplace_back(f.raster.low.y() + (foot + 0.5) * f.raster.pixel, wall.area);
    planes_.lines.push_back(std::move(wall));
  }

  /// The lowest and the highest row that are about as full as others: stray points do not make a wall higher.
  static std::pair<int, int> ends_of(std::vector<std::pair<int, int>> rows) {
    constexpr double full = 0.4;
    std::vector<int> counts;
    counts.reserve(rows.size());
    for (const auto& row : rows) counts.push_back(row.first);
    std::nth_element(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2), counts.end());
    const double least = full * counts[counts.size() / 2];
    std::erase_if(rows, [&](const auto& row) { return row.first < least; });
    return {rows.front().second, rows.back().second};
  }

  /// The value below which a share of the weight lies.
  static double quantile(std::vector<std::pair<double, double>> values, double share) {
    std::sort(values.begin(), values.end());
    double total = 0;
    for (const auto& v : values) total += v.second;
    double sum = 0;
    for (const auto& v : values) {
      sum += v.second;
      if (sum >= share * total) return v.first;
    }
    return values.back().first;
  }

  void settle_heights() {
    const auto largest = [&](const std::vector<CellSurface>& surfaces) {
      const CellSurface* best = nullptr;
      for (const auto& s : surfaces)
        if (best == nullptr || raster(s.primitive).area() > raster(best->primitive).area()) best = &s;
      return best;
    };
    const auto height = [&](const CellSurface& s) {
      const Raster& r = raster(s.primitive);
      return s.height_at((r.low + r.high()) / 2);
    };
    if (tops_.empty() && (planes_.floors.empty() || planes_.ceilings.empty()))
      throw Error(fmt::format("storey {} has no walls, and not both a floor and a ceiling", index_),
                  "a room needs planes around it: does the scan show one?");
    constexpr double most = 0.8;
    planes_.floor_height = planes_.floors.empty() ? quantile(bottoms_, 1 - most) : height(*largest(planes_.floors));
    const bool scanned =
        !planes_.ceilings.empty() && (tops_.empty() || 3 * area(planes_.ceilings) >= area(planes_.floors));
    planes_.ceiling_height = scanned ? height(*largest(planes_.ceilings)) : quantile(tops_, most);
    if (planes_.floors.empty()) planes_.floors.push_back({{{0, 0, 1}, -planes_.floor_height}, -1, {}});
    if (!scanned) planes_.ceilings.push_back({{{0, 0, -1}, planes_.ceiling_height}, -1, {}});
  }

  double area(const std::vector<CellSurface>& surfaces) const {
    double sum = 0;
    for (const auto& s : surfaces) {
      sum += raster(s.primitive).area();
      for (const auto joined : s.joined) sum += raster(joined).area();
    }
    return sum;
  }

  /// Surfaces that nowhere differ from a larger one by more than the gap are that one.
  void join_surfaces(std::vector<CellSurface>& surfaces, double min_gap) const {
    std::stable_sort(surfaces.begin(), surfaces.end(), [&](const auto& a, const auto& b) {
      return raster(a.primitive).area() > raster(b.primitive).area();
    });
    std::vector<CellSurface> kept;
    for (auto& surface : surfaces) {
      const Raster& r = raster(surface.primitive);
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

  void join_lines(double min_gap) {
    constexpr double parallel = 0.98;
    std::stable_sort(planes_.lines.begin(), planes_.lines.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area; });
    std::vector<WallLine> kept;
    for (auto& wall : planes_.lines) {
      const Eigen::Vector2d foot = -wall.line.offset * wall.line.normal;
      const Eigen::Vector2d a = foot + wall.begin * wall.line.along();
      const Eigen::Vector2d b = foot + wall.end * wall.line.along();
      const auto line = std::find_if(kept.begin(), kept.end(), [&](const WallLine& k) {
        return std::abs(k.line.normal.dot(wall.line.normal)) > parallel && std::abs(k.line.side(a)) <= min_gap &&
               std::abs(k.line.side(b)) <= min_gap;
      });
      if (line == kept.end()) {
        kept.push_back(std::move(wall));
        continue;
      }
      const Eigen::Vector2d along = line->line.along();
      line->begin = std::min({line->begin, along.dot(a), along.dot(b)});
      line->end = std::max({line->end, along.dot(a), along.dot(b)});
      line->area += wall.area;
      line->primitives.push_back(wall.primitives.front());
    }
    planes_.lines = std::move(kept);
  }

  /// The line over which two surfaces have the same height, as far as both were seen near it.
  void add_meeting_lines(const std::vector<CellSurface>& some, const std::vector<CellSurface>& others) {
    for (std::size_t i = 0; i < some.size(); ++i)
      for (std::size_t k = &some == &others ? i + 1 : 0; k < others.size(); ++k) {
        const CellSurface &a = some[i], &b = others[k];
        if (a.primitive < 0 || b.primitive < 0 || (is_level(a.plane) && is_level(b.plane))) continue;
        add_meeting_line(a, b);
      }
  }

  void add_meeting_line(const CellSurface& a, const CellSurface& b) {
    constexpr double least_slope = 0.05, step = 0.1, least_length = 0.3;
    const auto gradient = [](const CellSurface& s) -> Eigen::Vector2d {
      return -s.plane.normal.head<2>() / s.plane.normal.z();
    };
    const Eigen::Vector2d slope = gradient(a) - gradient(b);
    if (slope.norm() < least_slope) return;
    WallLine meeting;
    meeting.line.normal = slope.normalized();
    meeting.line.offset = (b.plane.offset / b.plane.normal.z() - a.plane.offset / a.plane.normal.z()) / slope.norm();
    std::map<int, int> seen;  // along the line: 1 by a, 2 by b
    mark(a, meeting.line, step, 1, seen);
    mark(b, meeting.line, step, 2, seen);
    int both = 0, first = 0, last = 0;
    for (const auto& [place, sides] : seen) {
      if (sides != 3) continue;
      if (both++ == 0) first = place;
      last = place;
    }
    if (both * step < least_length) return;
    meeting.begin = first * step;
    meeting.end = (last + 1) * step;
    planes_.lines.push_back(std::move(meeting));
  }

  void mark(const CellSurface& s, const Arrangement::Line& line, double step, int side,
            std::map<int, int>& seen) const {
    constexpr double beside = 0.4;
    const Raster& r = raster(s.primitive);
    const Eigen::Vector2d along = line.along();
    for (int y = 0; y < r.height; ++y)
      for (int x = 0; x < r.width; ++x) {
        if (!r.at(x, y)) continue;
        const Eigen::Vector2d p = r.centre(x, y);
        if (std::abs(line.side(p)) <= beside) seen[static_cast<int>(std::floor(along.dot(p) / step))] |= side;
      }
  }

  const Structure& structure_;
  const std::vector<Footprint>& footprints_;
  std::int32_t index_;
  StoreyPlanes planes_;
  std::vector<std::pair<double, double>> tops_, bottoms_;  // of walls, with their areas
};

/// Mean height and area of the largest level plane of a class in a storey; area 0: none.
std::pair<double, double> largest_level(const Structure& structure, const std::vector<Footprint>& footprints,
                                        std::int32_t storey, SurfaceClass surface) {
  std::pair<double, double> best{0, 0};
  for (std::size_t i = 0; i < structure.classes.size(); ++i) {
    if (structure.storeys[i] != storey || structure.classes[i] != surface) continue;
    const Raster& r = footprints[i].raster;
    const Plane& plane = structure.primitives->primitives[i].plane;
    if (!is_level(plane) || r.area() <= best.second) continue;
    best = {CellSurface{plane, 0, {}}.height_at((r.low + r.high()) / 2), r.area()};
  }
  return best;
}

/// Where the lowest wall of a storey begins; `far` without walls.
double lowest_wall(const Structure& structure, const std::vector<Footprint>& footprints, std::int32_t storey) {
  double lowest = far;
  for (std::size_t i = 0; i < structure.classes.size(); ++i)
    if (structure.storeys[i] == storey && structure.classes[i] == SurfaceClass::wall && !footprints[i].raster.empty())
      lowest = std::min(lowest, footprints[i].raster.low.y());
  return lowest;
}

}  // namespace

std::vector<StoreyPlanes> storey_planes(const Structure& structure, const std::vector<Footprint>& footprints,
                                        double min_gap) {
  constexpr double slab = 0.3;
  std::vector<StoreyPlanes> result;
  double low = -far;
  for (std::int32_t s = 0; s < structure.storey_count; ++s) {
    double high = far;
    if (s + 1 < structure.storey_count) {
      const auto ceiling = largest_level(structure, footprints, s, SurfaceClass::ceiling);
      const auto floor = largest_level(structure, footprints, s + 1, SurfaceClass::floor);
      if (floor.second == 0)
        high = ceiling.second > 0 ? ceiling.first + slab / 2 : lowest_wall(structure, footprints, s + 1) - slab / 2;
      else
        high =
            ceiling.second > 0 && ceiling.first < floor.first ? (ceiling.first + floor.first) / 2 : floor.first - slab;
    }
    result.push_back(Storey(structure, footprints, s).run(low, high, min_gap));
    low = high;
  }
  return result;
}

}  // namespace atrium::layout
