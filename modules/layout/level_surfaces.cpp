#include "modules/layout/level_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/layout/shelter.hpp"
#include "modules/layout/wall_lines.hpp"

namespace atrium::layout {
namespace {

constexpr double step_height = 0.25;  // metres: a floor so little higher is no furniture
constexpr double much = 0.3;          // of a surface that must lie over another to belong to it

struct Candidate {
  std::size_t primitive = 0;
  double height = 0, bottom = 0, top = 0, area = 0;
  bool up = false, slanted = false, raised = false;
  double sheltered = 1;
  Raster filled;  ///< in squares that it fills
};

class Levels {
 public:
  Levels(const PlanePrimitives& planes, const std::vector<Footprint>& footprints, double pixel,
         const LevelLimits& limits)
      : planes_(planes), footprints_(footprints), pixel_(pixel), limits_(limits) {
    for (std::size_t i = 0; i < planes.primitives.size(); ++i)
      if (!footprints[i].upright && !planes.primitives[i].inliers.empty()) levels_.push_back(level(i));
    std::stable_sort(levels_.begin(), levels_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.area > b.area; });
    find_shelter();
  }

  std::vector<LevelSurface> run() const {
    std::vector<const Candidate*> floors;
    for (const Candidate& l : levels_)
      if (is_floor(l, floors)) floors.push_back(&l);
    std::vector<const Candidate*> ceilings;
    for (const Candidate& l : levels_)
      if (is_ceiling(l, floors)) ceilings.push_back(&l);
    const std::vector<const Candidate*> all = ceilings;
    std::erase_if(ceilings, [&](const Candidate* l) { return is_void(*l, all); });
    leave_out_small_slopes(floors, ceilings);
    std::vector<LevelSurface> result = joined(floors, true);
    auto others = joined(ceilings, false);
    result.insert(result.end(), others.begin(), others.end());
    return result;
  }

 private:
  Candidate level(std::size_t i) const {
    const PlanePrimitive& primitive = planes_.primitives[i];
    Candidate result;
    result.primitive = i;
    result.top = -std::numeric_limits<double>::infinity();
    result.bottom = -result.top;
    for (const auto k : primitive.inliers) {
      const double z = planes_.cloud->points[k].z();
      result.height += z;
      result.top = std::max(result.top, z);
      result.bottom = std::min(result.bottom, z);
    }
    result.height /= static_cast<double>(primitive.inliers.size());
    // A steep surface is larger than its footprint.
    const Footprint& f = footprints_[i];
    result.filled = f.raster.coarse(std::max(1, static_cast<int>(std::lround(f.spacing / f.raster.pixel))));
    result.area = result.filled.area() / std::abs(primitive.plane.normal.z());
    result.up = primitive.plane.normal.z() > 0;
    result.slanted = !is_level(primitive.plane);
    return result;
  }

  bool is_wide(const Candidate& l) const {
    if (l.slanted) return true;
    const double pixel = l.filled.pixel;
    return l.filled.is_wide(std::max(limits_.least_width, pixel > pixel_ ? 3 * pixel : 0));
  }

  void find_shelter() {
    constexpr double mostly = 0.6;
    const Shelter shelter(planes_, footprints_, limits_.clearance);
    double best = 0;
    for (Candidate& l : levels_) {
      if (!l.up || l.area < limits_.least_area) continue;
      l.sheltered = shelter.covered(l.primitive);
      if (l.sheltered < mostly)
        if (const double enclosed = shelter.enclosed(l.primitive); enclosed > mostly)
          l.sheltered = std::max(l.sheltered, enclosed);
      best = std::max(best, l.area * l.sheltered);
      l.raised = l.area >= least_raised && shelter.raised(l.primitive);
    }
    if (best >= limits_.least_area) return;
    for (Candidate& l : levels_) l.sheltered = 1;
  }

  /// The share of a surface that lies over or under another, or within a step of its edge.
  double share_over(const Candidate& a, const Candidate& b) const {
    constexpr double beside = 0.3;  // metres
    const Raster &high = a.filled, &low = b.filled;
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(beside + low.pixel);
    const Eigen::AlignedBox2d around(low.low - margin, low.high() + margin);
    if (!around.intersects(Eigen::AlignedBox2d(high.low, high.high()))) return 0;
    const int reach = std::max(1, static_cast<int>(std::lround(beside / low.pixel)));
    int all = 0, both = 0;
    for (int y = 0; y < high.height; ++y)
      for (int x = 0; x < high.width; ++x) {
        if (!high.at(x, y)) continue;
        ++all;
        const Eigen::Vector2d p = high.centre(x, y);
        const int u = low.column(p.x()), v = low.row(p.y());
        bool near = false;
        for (const int du : {0, -reach, reach})
          for (const int dv : {0, -reach, reach}) near = near || low.at(u + du, v + dv);
        both += near ? 1 : 0;
      }
    return all > 0 ? static_cast<double>(both) / all : 0;
  }

  /// A wall that leans.
  bool is_steep(const Candidate& l) const {
    constexpr double steep = 0.5;  // cosine
    return std::abs(planes_.primitives[l.primitive].plane.normal.z()) < steep;
  }

  bool is_floor(const Candidate& l, const std::vector<const Candidate*>& larger) const {
    if (!l.up || l.area < limits_.least_area) return false;
    if (is_steep(l)) return true;
    if (l.sheltered < least_sheltered || !is_wide(l)) return false;
    if (l.raised) return true;
    // The floor ends where an alcove's bed begins; what is seen under it or before it is little.
    constexpr double some = 0.05;
    return std::none_of(larger.begin(), larger.end(), [&](const Candidate* floor) {
      if (is_steep(*floor)) return false;
      const double over = l.height - floor->height;
      const bool bed = !l.slanted && l.area < large_raised && over < bed_height;
      return over > step_height && over < limits_.clearance && share_over(l, *floor) > (bed ? some : much);
    });
  }

  bool is_ceiling(const Candidate& l, const std::vector<const Candidate*>& floors) const {
    if (l.up || l.area < limits_.least_area || !is_wide(l)) return false;
    const double top = l.slanted ? l.top : l.height;
    return std::none_of(floors.begin(), floors.end(), [&](const Candidate* floor) {
      return !is_steep(*floor) && top > floor->height && top < floor->height + limits_.clearance &&
             share_over(l, *floor) > much;
    });
  }

  /// Whether it lies too low to stand in over another ceiling, for the most part: above a suspended one, or under a
  /// roof.
  bool is_void(const Candidate& l, const std::vector<const Candidate*>& ceilings) const {
    if (l.slanted) return false;
    return std::any_of(ceilings.begin(), ceilings.end(), [&](const Candidate* below) {
      if (below->slanted || below->height >= l.height || l.height - below->height >= limits_.clearance) return false;
      return share_over(l, *below) > 0.5;
    });
  }

  /// Slanted surfaces that are no part of the room's shape: those that neither rise over most of its height, as a wall
  /// that leans does, nor cover much of the floor, alone or with those that they touch.
  void leave_out_small_slopes(std::vector<const Candidate*>& floors, std::vector<const Candidate*>& ceilings) const {
    std::vector<const Candidate*> slopes;
    for (const auto* levels : {&floors, &ceilings})
      for (const Candidate* l : *levels)
        if (l->slanted) slopes.push_back(l);
    std::vector<const Candidate*> small;
    for (const Candidate* l : slopes)
      if (!is_large_slope(*l, slopes, floors, ceilings)) small.push_back(l);
    const auto is_small = [&](const Candidate* l) { return std::find(small.begin(), small.end(), l) != small.end(); };
    std::erase_if(floors, is_small);
    std::erase_if(ceilings, is_small);
  }

  bool is_large_slope(const Candidate& l, const std::vector<const Candidate*>& slopes,
                      const std::vector<const Candidate*>& floors,
                      const std::vector<const Candidate*>& ceilings) const {
    constexpr double alone = 0.2, together = 0.4, rises = 0.6;  // of the floor; of the height
    // The floor below its middle, and the ceiling above it.
    const double middle = (l.bottom + l.top) / 2;
    const Candidate *floor = nullptr, *ceiling = nullptr;
    for (const Candidate* f : floors)
      if (!f->slanted && f->height <= middle && (floor == nullptr || f->height > floor->height) &&
          share_over(l, *f) > much)
        floor = f;
    for (const Candidate* c : ceilings)
      if (!c->slanted && c->height >= middle && (ceiling == nullptr || c->height < ceiling->height) &&
          share_over(l, *c) > much)
        ceiling = c;
    if (is_steep(l)) {
      const double height = floor != nullptr && ceiling != nullptr && ceiling->height > floor->height
                                ? ceiling->height - floor->height
                                : limits_.clearance;
      return l.top - l.bottom >= rises * height;
    }
    const Candidate* base = floor != nullptr ? floor : ceiling;
    if (base == nullptr) return true;
    const auto plan_area = [](const Candidate& a) { return a.filled.area(); };
    double area = plan_area(l);
    if (area >= alone * base->area) return true;
    for (const Candidate* o : slopes)
      if (o != &l && share_over(*o, *base) > much) area += plan_area(*o);
    return area >= together * base->area;
  }

  std::vector<LevelSurface> joined(const std::vector<const Candidate*>& levels, bool up) const {
    std::vector<CellSurface> surfaces;
    surfaces.reserve(levels.size());
    for (const Candidate* l : levels)
      surfaces.push_back({planes_.primitives[l->primitive].plane, static_cast<std::int32_t>(l->primitive), {}});
    join_surfaces(surfaces, footprints_, limits_.gap);
    std::vector<LevelSurface> result;
    for (auto& s : surfaces) {
      LevelSurface r;
      r.up = up;
      std::vector<std::int32_t> primitives = s.joined;
      primitives.push_back(s.primitive);
      for (const Candidate* l : levels) {
        if (std::find(primitives.begin(), primitives.end(), static_cast<std::int32_t>(l->primitive)) ==
            primitives.end())
          continue;
        r.area += l->area;
        r.height += l->area * l->height;
      }
      r.height /= r.area;
      r.surface = std::move(s);
      result.push_back(std::move(r));
    }
    return result;
  }

  const PlanePrimitives& planes_;
  const std::vector<Footprint>& footprints_;
  double pixel_;
  LevelLimits limits_;
  std::vector<Candidate> levels_;
};

}  // namespace

std::vector<LevelSurface> level_surfaces(const PlanePrimitives& planes, const std::vector<Footprint>& footprints,
                                         double pixel, const LevelLimits& limits) {
  return Levels(planes, footprints, pixel, limits).run();
}

}  // namespace atrium::layout
