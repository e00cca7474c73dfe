#include "modules/layout/storey_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"
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
    join_surfaces(planes_.floors, footprints_, min_gap);
    join_surfaces(planes_.ceilings, footprints_, min_gap);
    settle_heights();
    join_lines(planes_.lines, min_gap, [](const WallLine&, const WallLine&) { return false; });
    for (auto&& lines :
         {end_lines(planes_, footprints_), meeting_lines(planes_.ceilings, planes_.ceilings, footprints_),
          meeting_lines(planes_.ceilings, planes_.floors, footprints_)})
      planes_.lines.insert(planes_.lines.end(), lines.begin(), lines.end());
    return std::move(planes_);
  }

 private:
  const Raster& raster(std::int32_t primitive) const { return footprints_[static_cast<std::size_t>(primitive)].raster; }
  CellSurface surface(std::size_t i) const {
    return {structure_.primitives->primitives[i].plane, static_cast<std::int32_t>(i), {}};
  }

  void add_wall(std::size_t i) {
    auto wall = wall_line(*structure_.primitives, i, footprints_[i], planes_.low, planes_.high);
    if (!wall) return;
    tops_.emplace_back(wall->high, wall->area);
    bottoms_.emplace_back(wall->low, wall->area);
    planes_.lines.push_back(std::move(*wall));
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
    constexpr double most = 0.8, many = 0.4;
    planes_.floor_height =
        planes_.floors.empty() ? weighted_quantile(bottoms_, 1 - most) : height(*largest(planes_.floors));
    const bool scanned =
        !planes_.ceilings.empty() && (tops_.empty() || 3 * area(planes_.ceilings) >= area(planes_.floors));
    planes_.ceiling_height = scanned ? height(*largest(planes_.ceilings)) : weighted_quantile(tops_, most);
    if (planes_.floors.empty()) planes_.floors.push_back({{{0, 0, 1}, -planes_.floor_height}, -1, {}});
    if (!scanned) planes_.wall_end = weighted_quantile(tops_, many);
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
