#include "modules/layout/prism_stacks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/layout/coverage.hpp"
#include "modules/layout/plan_cells.hpp"
#include "modules/layout/prism_evidence.hpp"
#include "modules/layout/surface_reach.hpp"

namespace atrium::layout {
namespace {

bool is_steep(const Plane& plane) { return std::abs(plane.normal.z()) < 0.5; }

class StackBuilder {
 public:
  StackBuilder(const PlanePrimitives& planes, PrismSpace& space, double reach, const Context& context)
      : space_(space), context_(context) {
    for (const auto& s : space.surfaces) {
      const bool level = is_level(s.surface.plane);
      reaches_.emplace_back(planes, s.surface, level ? reach : is_steep(s.surface.plane) ? 0 : slope_reach);
    }
  }

  /// Cuts cells where surfaces cross; their lines are added to `lines`.
  void cut_crossings(Arrangement& arrangement, std::vector<Arrangement::Line>& lines) const {
    constexpr int most_passes = 12;
    for (int pass = 0; pass < most_passes; ++pass) {
      StoreyCells plan;
      take_cells(arrangement, plan);
      bool changed = false;
      for (std::size_t c = 0; c < plan.cells.size(); ++c) {
        context_.check_cancelled();
        for (const auto& line : crossings(plan, plan.cells[c])) {
          if (!arrangement.cut_one(c, static_cast<std::int32_t>(lines.size()), line)) continue;
          lines.push_back(line);
          changed = true;
          break;  // its parts have their turn in the next pass
        }
      }
      if (!changed) return;
    }
  }

  void fill_stacks() {
    space_.stacks.resize(space_.plan.cells.size());
    for (std::size_t c = 0; c < space_.plan.cells.size(); ++c) {
      const LayoutCell& cell = space_.plan.cells[c];
      auto& stack = space_.stacks[c].surfaces;
      stack = candidates(space_.plan, cell);
      const Eigen::Vector2d middle = middle_of(space_.plan, cell);
      std::stable_sort(stack.begin(), stack.end(), [&](std::int32_t a, std::int32_t b) {
        return space_.height(a, middle) < space_.height(b, middle);
      });
      // A slab without thickness: its ceiling below its floor.
      constexpr double one_level = 0.02;  // metres
      for (std::size_t k = 0; k + 1 < stack.size(); ++k)
        if (looks_up(stack[k]) && !looks_up(stack[k + 1]) &&
            space_.height(stack[k + 1], middle) - space_.height(stack[k], middle) < one_level)
          std::swap(stack[k], stack[k + 1]);
    }
  }

 private:
  static constexpr double slope_reach = 1;  // metres

  bool looks_up(std::int32_t surface) const { return space_.surfaces[static_cast<std::size_t>(surface)].up; }

  /// The surfaces over a cell. Those that were not seen there give way where they would cross another.
  std::vector<std::int32_t> candidates(const StoreyCells& plan, const LayoutCell& cell) const {
    std::vector<std::int32_t> near, result;
    std::vector<bool> seen;
    for (std::size_t s = 0; s < reaches_.size(); ++s) {
      if (!reaches_[s].touches(plan, cell, false)) continue;
      near.push_back(static_cast<std::int32_t>(s));
      seen.push_back(reaches_[s].touches(plan, cell, true));
    }
    for (std::size_t i = 0; i < near.size(); ++i) {
      const bool level = is_level(space_.surfaces[static_cast<std::size_t>(near[i])].surface.plane);
      bool gives_way = false;
      for (std::size_t k = 0; k < near.size() && !seen[i] && !gives_way; ++k)
        gives_way = k != i && (seen[k] || !level) && crosses(plan, cell, near[i], near[k]);
      if (!gives_way) result.push_back(near[i]);
    }
    return result;
  }

  bool crosses(const StoreyCells& plan, const LayoutCell& cell, std::int32_t a, std::int32_t b) const {
    constexpr double slack = 0.01;  // metres
    double least = 0, most = 0;
    for (const auto c : cell.corners) {
      const double off = space_.height(a, plan.vertices[c]) - space_.height(b, plan.vertices[c]);
      least = std::min(least, off);
      most = std::max(most, off);
    }
    return least < -slack && most > slack;
  }

  /// The lines over which two of a cell's surfaces cross within it.
  std::vector<Arrangement::Line> crossings(const StoreyCells& plan, const LayoutCell& cell) const {
    std::vector<Arrangement::Line> result;
    const auto stack = candidates(plan, cell);
    for (std::size_t i = 0; i < stack.size(); ++i)
      for (std::size_t k = i + 1; k < stack.size(); ++k) {
        if (!crosses(plan, cell, stack[i], stack[k])) continue;
        const Plane& a = space_.surfaces[static_cast<std::size_t>(stack[i])].surface.plane;
        const Plane& b = space_.surfaces[static_cast<std::size_t>(stack[k])].surface.plane;
        const Eigen::Vector2d slope = b.normal.head<2>() / b.normal.z() - a.normal.head<2>() / a.normal.z();
        constexpr double least_slope = 0.02;
        if (slope.norm() < least_slope) continue;
        result.push_back({slope.normalized(), (b.offset / b.normal.z() - a.offset / a.normal.z()) / slope.norm()});
      }
    return result;
  }

  PrismSpace& space_;
  const Context& context_;
  std::vector<SurfaceReach> reaches_;
};

}  // namespace

PrismSpace prism_space(const PlanePrimitives& planes, const std::vector<Footprint>& footprints,
                       std::vector<LevelSurface> surfaces, const std::vector<WallLine>& lines, double pixel,
                       double noise, double margin, double extension, double reach, const Context& context) {
  constexpr double tolerance = 1e-3, ridge_extension = 0.5;
  PrismSpace space;
  space.pixel = pixel;
  space.noise = noise;
  space.surfaces = std::move(surfaces);
  for (const auto& s : space.surfaces) space.plan.floors.push_back(s.surface);
  space.plan.ceilings = space.plan.floors;
  Eigen::AlignedBox2d box = extent_of({&space.plan.floors}, lines, footprints);
  box = {box.min() - Eigen::Vector2d::Constant(margin), box.max() + Eigen::Vector2d::Constant(margin)};
  Arrangement arrangement(box.min(), box.max(), tolerance);
  std::vector<Arrangement::Line> all;
  for (const auto& wall : lines) {
    const double further = wall.primitives.empty() ? ridge_extension : extension;
    arrangement.cut(static_cast<std::int32_t>(all.size()), wall.line, wall.begin - further, wall.end + further);
    all.push_back(wall.line);
  }
  StackBuilder builder(planes, space, reach, context);
  builder.cut_crossings(arrangement, all);
  take_cells(arrangement, space.plan);
  for (std::size_t i = 0; i < all.size(); ++i)
    space.plan.lines.push_back(
        {all[i].normal, all[i].offset, i < lines.size() ? lines[i].primitives : std::vector<std::int32_t>{}});
  add_border(box, space.plan);
  builder.fill_stacks();
  measure_stacks(planes, footprints, space, context);
  return space;
}

double common_height(const PrismSpace& space, const CellEdge& edge, std::size_t left, std::size_t right) {
  const PrismStack& a = space.stacks[static_cast<std::size_t>(edge.left)];
  const PrismStack& b = space.stacks[static_cast<std::size_t>(edge.right)];
  const Eigen::Vector2d& from = space.plan.vertices[edge.from];
  const Eigen::Vector2d& to = space.plan.vertices[edge.to];
  double sum = 0;
  for (const auto& [share, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
    const Eigen::Vector2d p = from + (to - from) * share;
    double low = -1e9, high = 1e9;
    for (const auto& [stack, prism] : {std::pair{&a, left}, {&b, right}}) {
      if (prism > 0) low = std::max(low, space.height(stack->surfaces[prism - 1], p));
      if (prism < stack->surfaces.size()) high = std::min(high, space.height(stack->surfaces[prism], p));
    }
    sum += weight * std::max(0.0, high - low) / 6;
  }
  return sum;
}

}  // namespace atrium::layout
