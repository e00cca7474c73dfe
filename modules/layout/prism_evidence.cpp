#include "modules/layout/prism_evidence.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "modules/layout/cell_map.hpp"
#include "modules/layout/coverage.hpp"

namespace atrium::layout {
namespace {

struct Hit {
  float x, y, z;
  std::int32_t primitive;
};

/// What was seen over one place, as one of its levels: a surface of the stack (its place there) or furniture (−1).
struct SeenLevel {
  double z = 0;
  bool up = false;
  int place = -1;
};
using SeenColumn = std::vector<SeenLevel>;

/// The places of a cell at which it is looked at.
struct CellPlaces {
  Eigen::AlignedBox2d box;
  double step = 0;
  int width = 0, height = 0;
  std::vector<SeenColumn> columns;

  CellPlaces(const StoreyCells& plan, const LayoutCell& cell, double pixel) {
    for (const auto v : cell.corners) box.extend(plan.vertices[v]);
    step = std::min(pixel, std::sqrt(cell.area) / 4);
    width = std::max(1, static_cast<int>(std::ceil(box.sizes().x() / step)));
    height = std::max(1, static_cast<int>(std::ceil(box.sizes().y() / step)));
    columns.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  SeenColumn& at(int x, int y) {
    return columns[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  Eigen::Vector2d place(int x, int y) const { return box.min() + Eigen::Vector2d(x + 0.5, y + 0.5) * step; }
  /// Adds what was seen at p to the columns of the places at most `half` away along each axis.
  void add(const SeenLevel& seen, const Eigen::Vector2d& p, double half, double same_height) {
    const Eigen::Vector2d q = (p - box.min()) / step;
    const int reach = static_cast<int>(std::floor(half / step + 0.5));
    const int x0 = static_cast<int>(q.x()), y0 = static_cast<int>(q.y());
    for (int y = std::max(0, y0 - reach); y <= std::min(height - 1, y0 + reach); ++y)
      for (int x = std::max(0, x0 - reach); x <= std::min(width - 1, x0 + reach); ++x) {
        if (std::abs(x + 0.5 - q.x()) * step > half || std::abs(y + 0.5 - q.y()) * step > half) continue;
        SeenColumn& column = at(x, y);
        if (std::none_of(column.begin(), column.end(), [&](const SeenLevel& s) {
              return s.place == seen.place && s.up == seen.up &&
                     (seen.place >= 0 || std::abs(s.z - seen.z) < same_height);
            }))
          column.push_back(seen);
      }
  }
};

class StackMeasuring {
 public:
  StackMeasuring(const PlanePrimitives& planes, const std::vector<Footprint>& footprints, PrismSpace& space)
      : planes_(planes), footprints_(footprints), space_(space), surface_of_(planes.primitives.size(), -1) {
    for (std::size_t s = 0; s < space.surfaces.size(); ++s)
      for (const auto p : primitives_of(space.surfaces[s].surface))
        surface_of_[static_cast<std::size_t>(p)] = static_cast<std::int32_t>(s);
  }

  void run(const Context& context) {
    const auto hits = hits_by_cell();
    context.parallel_for(
        hits.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t c = begin; c < end; ++c) measure_cell(c, hits[c]);
        },
        16);
  }

 private:
  std::vector<std::vector<Hit>> hits_by_cell() const {
    const CellMap map(space_.plan, space_.pixel);
    std::vector<std::vector<Hit>> hits(space_.plan.cells.size());
    for (std::size_t p = 0; p < planes_.primitives.size(); ++p) {
      if (footprints_[p].upright) continue;
      for (const auto i : planes_.primitives[p].inliers) {
        const Eigen::Vector3f& q = planes_.cloud->points[i];
        const std::int32_t cell = map.at(q.head<2>().cast<double>());
        if (cell >= 0)
          hits[static_cast<std::size_t>(cell)].push_back({q.x(), q.y(), q.z(), static_cast<std::int32_t>(p)});
      }
    }
    return hits;
  }

  /// Whether a wall's line runs along the cell nearer to p than the noise reaches.
  bool near_wall(const LayoutCell& cell, const Eigen::Vector2d& p) const {
    return std::any_of(cell.edges.begin(), cell.edges.end(), [&](std::uint32_t e) {
      const std::int32_t line = space_.plan.edges[e].line;
      if (line < 0 || space_.plan.lines[static_cast<std::size_t>(line)].primitives.empty()) return false;
      const CellLine& l = space_.plan.lines[static_cast<std::size_t>(line)];
      return std::abs(l.normal.dot(p) + l.offset) < 3 * space_.noise;
    });
  }

  void add_hit(const PrismStack& stack, const Hit& hit, CellPlaces& places) const {
    const auto primitive = static_cast<std::size_t>(hit.primitive);
    const auto& surfaces = stack.surfaces;
    const auto it = surface_of_[primitive] < 0 ? surfaces.end()
                                               : std::find(surfaces.begin(), surfaces.end(), surface_of_[primitive]);
    const bool in_stack = it != surfaces.end();
    const bool up = planes_.primitives[primitive].plane.normal.z() > 0;
    if (!in_stack && !up) return;   // undersides of furniture
    constexpr double sparse = 1.2;  // a surface that does not fill its squares covers what lies around its points
    const double spacing = footprints_[primitive].spacing;
    const double half = std::max(space_.pixel, spacing > sparse * space_.pixel ? spacing : 0) / 2;
    places.add({hit.z, up, in_stack ? static_cast<int>(it - surfaces.begin()) : -1}, {hit.x, hit.y}, half,
               space_.pixel);
  }

  void measure_cell(std::size_t c, const std::vector<Hit>& hits) const {
    const LayoutCell& cell = space_.plan.cells[c];
    PrismStack& stack = space_.stacks[c];
    const std::size_t n = stack.surfaces.size();
    stack.cover.assign(n, 0);
    stack.free.assign(n + 1, 0);
    stack.on_floor.assign(n + 1, 0);
    CellPlaces places(space_.plan, cell, space_.pixel);
    for (const Hit& hit : hits) add_hit(stack, hit, places);
    int samples = 0;
    for (int y = 0; y < places.height; ++y)
      for (int x = 0; x < places.width; ++x) {
        const Eigen::Vector2d p = places.place(x, y);
        if (!is_inside(space_.plan.vertices, cell.corners, p) || near_wall(cell, p)) continue;
        ++samples;
        add_place(p, places.at(x, y), stack);
      }
    if (samples == 0) return;
    for (auto* values : {&stack.cover, &stack.free, &stack.on_floor})
      for (auto& v : *values) v /= samples;
  }

  void add_place(const Eigen::Vector2d& p, SeenColumn& column, PrismStack& stack) const {
    if (column.empty()) return;
    std::vector<double> heights;
    heights.reserve(stack.surfaces.size());
    for (const auto s : stack.surfaces) heights.push_back(space_.height(s, p));
    for (SeenLevel& s : column)
      if (s.place >= 0) s.z = heights[static_cast<std::size_t>(s.place)];
    std::sort(column.begin(), column.end(),
              [](const SeenLevel& a, const SeenLevel& b) { return std::tie(a.z, a.place) < std::tie(b.z, b.place); });
    std::vector<bool> is_free(stack.free.size(), false);
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (column[i].place < 0) continue;
      const auto place = static_cast<std::size_t>(column[i].place);
      stack.cover[place] += 1;
      if (column[i].up) {
        if (i + 1 == column.size() || column[i + 1].up) stack.on_floor[place + 1] += 1;
        continue;
      }
      const double bottom = seen_down_to(stack, heights, column, i);
      for (std::size_t prism = place; prism > 0 && (heights[prism - 1] + heights[prism]) / 2 >= bottom; --prism)
        is_free[prism] = true;
    }
    for (std::size_t prism = 0; prism < is_free.size(); ++prism) stack.free[prism] += is_free[prism] ? 1 : 0;
  }

  /// How far down from a ceiling something was seen through: to what was seen below it, or else to the floor that is
  /// hidden there.
  double seen_down_to(const PrismStack& stack, const std::vector<double>& heights, const SeenColumn& column,
                      std::size_t ceiling) const {
    constexpr double one_level = 0.02, doubled = 0.3, unknown_depth = 2.5;  // metres
    const SeenLevel& s = column[ceiling];
    std::size_t k = ceiling;
    while (k > 0 && s.z - column[k - 1].z < one_level) --k;
    if (k > 0 && column[k - 1].up) return column[k - 1].z;
    const int floor = floor_below(stack, static_cast<std::size_t>(s.place));
    const double hidden = floor >= 0 ? heights[static_cast<std::size_t>(floor)] : s.z - unknown_depth;
    if (k == 0 || (floor >= 0 && hidden > column[k - 1].z)) return hidden;
    // Another ceiling below, with no floor between: nothing is known of what lies between layers of one ceiling.
    return s.z - column[k - 1].z < doubled ? s.z : column[k - 1].z;
  }

  /// The place in the stack of the highest floor below a surface; −1: none.
  int floor_below(const PrismStack& stack, std::size_t place) const {
    for (std::size_t k = place; k > 0; --k)
      if (space_.surfaces[static_cast<std::size_t>(stack.surfaces[k - 1])].up) return static_cast<int>(k) - 1;
    return -1;
  }

  const PlanePrimitives& planes_;
  const std::vector<Footprint>& footprints_;
  PrismSpace& space_;
  std::vector<std::int32_t> surface_of_;
};

}  // namespace

void measure_stacks(const PlanePrimitives& planes, const std::vector<Footprint>& footprints, PrismSpace& space,
                    const Context& context) {
  StackMeasuring(planes, footprints, space).run(context);
}

}  // namespace atrium::layout
