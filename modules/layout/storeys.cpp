#include "modules/layout/storeys.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/api/text.hpp"
#include "modules/layout/raster.hpp"
#include "modules/layout/shelter.hpp"
#include "modules/layout/wall_lines.hpp"

namespace atrium::layout {
namespace {

struct Level {
  std::size_t primitive = 0;
  double height = 0;  ///< mean z of the points
  double top = 0;     ///< greatest z
  double area = 0;
  bool raised = false;   ///< a floor that walls stand on, however high it lies over the main one
  double sheltered = 1;  ///< of a floor: the share of it that is part of a building
  bool up = false, slanted = false;
  double sheltered_area() const { return area * sheltered; }
};

constexpr double main_share = 0.5;      // of the largest floor: as large as one
constexpr double least_large = 2.0;     // m²: what may be a slab at all
constexpr double lower_ceilings = 0.5;  // metres under the main one, where no floor tells what is a ceiling
constexpr double low_step = 0.25;       // metres: a floor so little higher needs no walls around it

class Finder {
 public:
  Finder(const PlanePrimitives& planes, const Storeys::Params& params, Context& context)
      : planes_(planes), params_(params), context_(context), pixel_(fitting_pixel(planes, params.pixel, context)) {
    footprints_ = footprints(planes, pixel_, context);
    for (std::size_t i = 0; i < planes.primitives.size(); ++i)
      if (!footprints_[i].upright && !planes.primitives[i].inliers.empty()) levels_.push_back(level(i));
    find_shelter();
    for (const auto& l : levels_)
      if (!l.slanted) largest_ = std::max(largest_, l.sheltered_area());
  }

  Structure run() {
    if (largest_ == 0)
      throw Error("no plane is level: there is neither floor nor ceiling",
                  "z must point up (align.z_axis before this node)");
    find_cuts();
    Structure result;
    result.classes.assign(planes_.primitives.size(), SurfaceClass::object);
    result.storeys.assign(planes_.primitives.size(), -1);
    result.storey_count = static_cast<std::int32_t>(cuts_.size()) + 1;
    for (std::int32_t s = 0; s < result.storey_count; ++s) sort_levels(s, result);
    for (std::size_t i = 0; i < planes_.primitives.size(); ++i) sort_wall(i, result);
    leave_out_far_walls(result);
    return result;
  }

 private:
  Level level(std::size_t i) const {
    const PlanePrimitive& primitive = planes_.primitives[i];
    Level result;
    result.primitive = i;
    result.top = -std::numeric_limits<double>::infinity();
    for (const auto k : primitive.inliers) {
      const double z = planes_.cloud->points[k].z();
      result.height += z;
      result.top = std::max(result.top, z);
    }
    result.height /= static_cast<double>(primitive.inliers.size());
    result.area = filled(i).area();
    result.up = primitive.plane.normal.z() > 0;
    result.slanted = !is_level(primitive.plane);
    return result;
  }

  /// A plane's raster in squares that it fills.
  Raster filled(std::size_t plane) const {
    const Footprint& f = footprints_[plane];
    return f.raster.coarse(std::max(1, static_cast<int>(std::lround(f.spacing / f.raster.pixel))));
  }

  /// Whether it holds a square of min_width, or one of three by three of the squares that a sparse surface fills.
  bool is_wide(const Level& l) const {
    const Raster raster = filled(l.primitive);
    return raster.is_wide(std::max(params_.min_width, raster.pixel > pixel_ ? 3 * raster.pixel : 0));
  }

  /// What no ceiling covers and no walls enclose is outside. Where nothing is sheltered, nothing is known of it.
  void find_shelter() {
    constexpr double mostly = 0.6;  // of the directions: beside a facade it is half of them at most
    const Shelter shelter(planes_, footprints_, params_.min_clearance);
    double best = 0;
    for (Level& l : levels_) {
      if (!l.up || l.area < params_.min_area) continue;
      l.sheltered = shelter.covered(l.primitive);
      if (const double enclosed = l.sheltered < mostly ? shelter.enclosed(l.primitive) : 0; enclosed > mostly)
        l.sheltered = std::max(l.sheltered, enclosed);
      best = std::max(best, l.sheltered_area());
      l.raised = !l.slanted && l.area >= least_raised && shelter.raised(l.primitive);
    }
    double left_out = 0;
    for (Level& l : levels_) {
      if (best < params_.min_area) l.sheltered = 1;
      if (l.up && l.sheltered < least_sheltered && l.area >= least_large) left_out += l.area;
    }
    if (left_out > 0)
      context_.info(fmt::format("{:.0f} m2 of level surfaces lie outside: no ceiling covers and no walls enclose them",
                                left_out));
  }

  bool large(const Level& l) const {
    return !l.slanted && l.sheltered_area() >= least_large && l.sheltered_area() >= 0.05 * largest_;
  }

  /// Square metres of b over a.
  double overlap(const Level& a, const Level& b) const {
    const Raster& low = footprints_[a.primitive].raster;
    const Raster& high = footprints_[b.primitive].raster;
    std::size_t both = 0;
    for (int y = 0; y < low.height; ++y)
      for (int x = 0; x < low.width; ++x)
        if (low.at(x, y) && high.at(low.centre(x, y))) ++both;
    return static_cast<double>(both) * pixel_ * pixel_;
  }
  /// Whether the floor goes on under much of it: then it is a table, or many.
  bool stands_on(const Level& l, const Level& floor) const {
    constexpr double much = 0.3;
    if (&l == &floor || l.height <= floor.height + low_step || l.height >= floor.height + params_.min_clearance)
      return false;
    const Raster high = filled(l.primitive), low = filled(floor.primitive);
    int all = 0, both = 0;
    for (int y = 0; y < high.height; ++y)
      for (int x = 0; x < high.width; ++x) {
        if (!high.at(x, y)) continue;
        ++all;
        both += low.at(high.centre(x, y)) ? 1 : 0;
      }
    return both > much * all;
  }
  /// Whether a level ceiling covers, for the most part, spaces too low to stand in over other ceilings: the void over
  /// suspended ones, or under a roof.
  bool over_a_slab(const Level& l, double ground) const {
    if (l.slanted) return false;
    const Eigen::AlignedBox2d box(footprints_[l.primitive].raster.low, footprints_[l.primitive].raster.high());
    std::vector<Raster> lower;
    for (const Level& c : levels_)
      if (!c.up && !c.slanted && c.height >= ground + params_.min_clearance && c.height < l.height &&
          l.height - c.height < params_.min_clearance && c.area >= params_.min_area && is_wide(c) &&
          box.intersects({footprints_[c.primitive].raster.low, footprints_[c.primitive].raster.high()}))
        lower.push_back(filled(c.primitive));
    if (lower.empty()) return false;
    const Raster own = filled(l.primitive);
    int all = 0, over = 0;
    for (int y = 0; y < own.height; ++y)
      for (int x = 0; x < own.width; ++x) {
        if (!own.at(x, y)) continue;
        ++all;
        const Eigen::Vector2d p = own.centre(x, y);
        over += std::any_of(lower.begin(), lower.end(), [&](const Raster& r) { return r.at(p); }) ? 1 : 0;
      }
    return over >= main_share * all;
  }
  bool room_below(const Level& ceiling) const {
    return std::any_of(levels_.begin(), levels_.end(), [&](const Level& l) {
      return l.up && large(l) && ceiling.height - l.height >= params_.min_clearance &&
             overlap(l, ceiling) >= least_large / 2;
    });
  }
  /// Whether most of it lies under a level ceiling with room to stand.
  bool has_ceiling_of_its_own(const Level& floor) const {
    return std::any_of(levels_.begin(), levels_.end(), [&](const Level& l) {
      return !l.up && !l.slanted && l.height - floor.height >= params_.min_clearance &&
             overlap(floor, l) >= main_share * floor.area;
    });
  }
  bool room_above(const Level& floor) const {
    double top = floor.height;
    for (const auto& l : levels_)
      if (!l.up) top = std::max(top, l.top);
    for (std::size_t i = 0; i < footprints_.size(); ++i)
      if (footprints_[i].upright && !footprints_[i].raster.empty())
        top = std::max(top, footprints_[i].raster.high().y());
    return top - floor.height >= params_.min_clearance;
  }

  void find_cuts() {
    struct Slab {
      double low, high, area;
    };
    std::vector<Slab> slabs;
    for (const auto& floor : levels_) {
      if (!floor.up || !large(floor) || !room_above(floor)) continue;
      for (const auto& below : levels_) {
        if (!large(below) || below.height >= floor.height) continue;
        const double gap = floor.height - below.height;
        if (!below.up && gap <= params_.max_slab && room_below(below))
          slabs.push_back({below.height, floor.height, std::min(floor.area, below.area)});
        else if (below.up && gap >= params_.min_clearance && overlap(below, floor) >= 2 * least_large)
          slabs.push_back({std::max(below.height + params_.min_clearance / 2, floor.height - params_.max_slab / 2),
                           floor.height, overlap(below, floor) / 2});
      }
    }
    std::stable_sort(slabs.begin(), slabs.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    for (const auto& slab : slabs) {
      const double cut = (slab.low + slab.high) / 2;
      const bool known =
          std::any_of(cuts_.begin(), cuts_.end(), [&](double c) { return std::abs(c - cut) < params_.min_clearance; });
      if (!known) cuts_.push_back(cut);
    }
    std::sort(cuts_.begin(), cuts_.end());
  }

  std::int32_t storey_of(double z) const {
    return static_cast<std::int32_t>(std::lower_bound(cuts_.begin(), cuts_.end(), z) - cuts_.begin());
  }

  /// The largest level surface of a storey that is large enough and wanted; null: none.
  template <class Wanted>
  const Level* largest(std::int32_t storey, Wanted wanted) const {
    const Level* best = nullptr;
    for (const auto& l : levels_) {
      if (l.slanted || l.area < params_.min_area || storey_of(l.height) != storey || !wanted(l)) continue;
      if (best == nullptr || l.sheltered_area() > best->sheltered_area()) best = &l;
    }
    return best;
  }

  /// Whether most of the storey's walls go on below a level, so that they do not stand on it: it is furniture, all
  /// that was seen where the floor was not.
  bool is_over_feet(const Level& l, const std::vector<WallLine>& walls) const {
    constexpr double most = 0.6;  // of the walls' length
    double all = 0, below = 0;
    for (const WallLine& wall : walls) {
      if (wall.high < l.height + params_.min_clearance / 2) continue;
      all += wall.end - wall.begin;
      below += wall.low < l.height - low_step ? wall.end - wall.begin : 0;
    }
    return below > most * all;
  }

  /// All upright planes, as far as they lie in the storey.
  std::vector<WallLine> walls_of(std::int32_t storey) const {
    const auto s = static_cast<std::size_t>(storey);
    const double low = s > 0 ? cuts_[s - 1] : -1e9, high = s < cuts_.size() ? cuts_[s] : 1e9;
    std::vector<WallLine> walls;
    for (std::size_t i = 0; i < footprints_.size(); ++i)
      if (auto wall = wall_line(planes_, i, footprints_[i], low, high)) walls.push_back(std::move(*wall));
    return walls;
  }

  /// Whether a level surface has a bed's size and height: much of the floor of a small room.
  static bool is_bed(const Level& l, double ground) {
    return l.area < large_raised && l.height > ground + low_step && l.height < ground + bed_height;
  }

  void sort_levels(std::int32_t storey, Structure& result) const {
    const Level* main_ceiling = largest(storey, [](const Level& l) { return !l.up; });
    const std::vector<WallLine> walls = walls_of(storey);
    const Level* main_floor = largest(storey, [&](const Level& l) {
      // What lies right under a larger ceiling is the top of a beam or a lamp.
      const bool at_ceiling = main_ceiling != nullptr && l.area < main_ceiling->area &&
                              l.height > main_ceiling->height - params_.min_clearance;
      return l.up && l.sheltered >= least_sheltered && !at_ceiling && !is_over_feet(l, walls);
    });
    if (main_floor == nullptr) context_.warn(fmt::format("storey {}: no floor was found", storey));
    const double ground = main_floor != nullptr     ? main_floor->height
                          : main_ceiling != nullptr ? main_ceiling->height - params_.min_clearance - lower_ceilings
                          : storey > 0              ? cuts_[static_cast<std::size_t>(storey) - 1]
                                                    : -1e9;
    bool ceilings = false;
    for (const auto& l : levels_) {
      if (storey_of(l.height) != storey || l.area < params_.min_area || !is_wide(l)) continue;
      if (l.up && l.sheltered < least_sheltered) continue;
      const bool is_floor = l.up && main_floor != nullptr && !stands_on(l, *main_floor) &&
                            (l.height <= ground + (l.raised ? params_.max_step : low_step) ||
                             (((l.area >= main_share * main_floor->area && !is_bed(l, ground)) || l.raised) &&
                              ((main_ceiling != nullptr && main_ceiling->height - l.height >= params_.min_clearance) ||
                               has_ceiling_of_its_own(l))));
      const bool is_ceiling =
          !l.up && (l.slanted ? l.top : l.height) >= ground + params_.min_clearance && !over_a_slab(l, ground);
      if (!is_floor && !is_ceiling) continue;
      result.classes[l.primitive] = is_floor ? SurfaceClass::floor : SurfaceClass::ceiling;
      result.storeys[l.primitive] = storey;
      ceilings = ceilings || is_ceiling;
    }
    if (!ceilings) context_.warn(fmt::format("storey {}: no ceiling was found", storey));
  }

  void sort_wall(std::size_t i, Structure& result) const {
    const Footprint& f = footprints_[i];
    if (!f.upright || f.raster.empty() || f.raster.area() < params_.min_wall_area ||
        f.raster.width * pixel_ < params_.min_wall_length)
      return;
    double best = -1;
    for (std::int32_t s = 0; s < result.storey_count; ++s) {
      const double low = s > 0 ? cuts_[static_cast<std::size_t>(s) - 1] : -1e9;
      const double high = s + 1 < result.storey_count ? cuts_[static_cast<std::size_t>(s)] : 1e9;
      const double overlap = std::min(high, f.raster.high().y()) - std::max(low, f.raster.low.y());
      if (overlap <= best) continue;
      best = overlap;
      result.storeys[i] = s;
    }
    result.classes[i] = SurfaceClass::wall;
  }

  /// Facades across the street.
  void leave_out_far_walls(Structure& result) const {
    constexpr double far = 3;  // metres from any floor or ceiling
    std::vector<Eigen::AlignedBox2d> boxes;
    for (std::size_t i = 0; i < result.classes.size(); ++i)
      if (result.classes[i] == SurfaceClass::floor || result.classes[i] == SurfaceClass::ceiling)
        boxes.emplace_back(footprints_[i].raster.low, footprints_[i].raster.high());
    if (boxes.empty()) return;
    for (std::size_t i = 0; i < result.classes.size(); ++i) {
      if (result.classes[i] != SurfaceClass::wall) continue;
      const Raster& r = footprints_[i].raster;
      const Plane& plane = planes_.primitives[i].plane;
      const double flat = plane.normal.head<2>().norm();
      const Eigen::Vector2d foot =
          -(plane.offset + plane.normal.z() * (r.low.y() + r.high().y()) / 2) / (flat * flat) * plane.normal.head<2>();
      double nearest = far + 1;
      for (double t = r.low.x(); t <= r.high().x(); t += std::max(1.0, r.pixel))
        for (const auto& box : boxes)
          nearest = std::min(nearest, box.exteriorDistance(Eigen::Vector2d(foot + t * footprints_[i].along)));
      if (nearest <= far) continue;
      result.classes[i] = SurfaceClass::object;
      result.storeys[i] = -1;
    }
  }

  const PlanePrimitives& planes_;
  const Storeys::Params& params_;
  Context& context_;
  double pixel_;
  std::vector<Footprint> footprints_;
  std::vector<Level> levels_;
  double largest_ = 0;
  std::vector<double> cuts_;
};

}  // namespace

Storeys::Out Storeys::run(const In& in, const Params& params, Context& context) {
  Out out{Finder(*in.planes, params, context).run()};
  out.structure.primitives = in.planes;
  const auto candidates = [&](SurfaceClass c) {
    const auto count = std::count(out.structure.classes.begin(), out.structure.classes.end(), c);
    return counted(static_cast<std::size_t>(count), name_of(c));
  };
  context.info(fmt::format("{}; candidates: {}, {}, {}", counted(out.structure.storey_count, "storey"),
                           candidates(SurfaceClass::floor), candidates(SurfaceClass::ceiling),
                           candidates(SurfaceClass::wall)));
  return out;
}

}  // namespace atrium::layout
