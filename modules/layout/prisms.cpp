#include "modules/layout/prisms.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/layout/ceilings_behind.hpp"
#include "modules/layout/coverage.hpp"
#include "modules/layout/plan_cells.hpp"
#include "modules/layout/prism_cut.hpp"
#include "modules/layout/prism_rooms.hpp"

namespace atrium::layout {
namespace {

constexpr double unbounded = 1e9;

/// Walls of different storeys on nearly one line keep a line each; on one line they share it.
bool of_other_storeys(const WallLine& a, const WallLine& b) {
  constexpr double common = 0.3, low_piece = 1.5, one_line = 2e-3;  // metres
  const Eigen::Vector2d foot = -b.line.offset * b.line.normal;
  const auto off = [&](double t) { return std::abs(a.line.side(foot + t * b.line.along())); };
  if (std::max(off(b.begin), off(b.end)) <= one_line) return false;
  const double overlap = std::min(a.high, b.high) - std::max(a.low, b.low);
  const bool piece = std::min(a.high - a.low, b.high - b.low) < low_piece;
  return overlap < (piece ? -low_piece : common);
}

/// Whether a wall leans so far that an upright plane would miss it.
bool leans(const PlanePrimitive& primitive, const Footprint& footprint) {
  constexpr double least_sine = 0.05, least_rise = 1.5, least_lean = 0.12, least_area = 2;  // metres, m²
  if (!footprint.upright || footprint.raster.empty()) return false;
  const double slope = std::abs(primitive.plane.normal.z());
  const double rise = footprint.raster.height * footprint.raster.pixel;
  return slope > least_sine && rise > least_rise && slope * rise > least_lean && footprint.raster.area() > least_area;
}

/// Walls that lean are seen from above, as floors and ceilings are.
void lean(const PlanePrimitives& planes, double pixel, std::vector<Footprint>& seen) {
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (leans(planes.primitives[i], seen[i])) seen[i] = footprint(planes.primitives[i], *planes.cloud, pixel, true);
}

/// What leans and is no surface is an upright wall again.
void stand_up(const PlanePrimitives& planes, const std::vector<LevelSurface>& surfaces, double pixel,
              std::vector<Footprint>& seen) {
  std::vector<bool> taken(seen.size(), false);
  for (const auto& s : surfaces)
    for (const auto p : primitives_of(s.surface)) taken[static_cast<std::size_t>(p)] = true;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (!taken[i] && !seen[i].upright && is_upright(planes.primitives[i].plane))
      seen[i] = footprint(planes.primitives[i], *planes.cloud, pixel);
}

/// Facades across the street: walls that stand more than 3 m from any floor or ceiling.
bool is_far(const WallLine& wall, const std::vector<Eigen::AlignedBox2d>& boxes) {
  constexpr double far = 3;
  const Eigen::Vector2d foot = -wall.line.offset * wall.line.normal;
  for (double t = wall.begin; t <= wall.end; t += std::min(1.0, std::max(0.1, wall.end - wall.begin)))
    for (const auto& box : boxes)
      if (box.exteriorDistance(Eigen::Vector2d(foot + t * wall.line.along())) <= far) return false;
  return true;
}

std::vector<WallLine> walls_of(const PlanePrimitives& planes, const std::vector<Footprint>& footprints,
                               const std::vector<LevelSurface>& surfaces, double pixel, const Prisms::Params& params) {
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const auto& s : surfaces)
    for (const auto p : primitives_of(s.surface)) {
      const Raster& r = footprints[static_cast<std::size_t>(p)].raster;
      boxes.emplace_back(r.low, r.high());
    }
  std::vector<WallLine> walls;
  for (std::size_t i = 0; i < planes.primitives.size(); ++i) {
    const Footprint& f = footprints[i];
    if (!f.upright || f.raster.empty() || f.raster.area() < params.min_wall_area ||
        f.raster.width * pixel < params.min_wall_length)
      continue;
    auto wall = wall_line(planes, i, f, -unbounded, unbounded);
    if (wall && !is_far(*wall, boxes)) walls.push_back(std::move(*wall));
  }
  return walls;
}

std::size_t prisms_of(const PrismSpace& space) {
  std::size_t prisms = 0;
  for (const auto& stack : space.stacks) prisms += stack.surfaces.size() + 1;
  return prisms;
}

/// Each primitive's class, and the storey that it belongs to.
Structure structure_of(const Prisms::In& in, const std::vector<Footprint>& footprints,
                       const std::vector<LevelSurface>& surfaces, const std::vector<WallLine>& walls,
                       const std::vector<StoreyCells>& storeys) {
  Structure result;
  result.primitives = in.planes;
  result.classes.assign(in.planes->primitives.size(), SurfaceClass::object);
  result.storeys.assign(in.planes->primitives.size(), -1);
  result.storey_count = std::max<std::int32_t>(1, static_cast<std::int32_t>(storeys.size()));
  const auto storey_at = [&](double z) {
    std::int32_t s = 0;
    while (s + 1 < static_cast<std::int32_t>(storeys.size()) && z > storeys[static_cast<std::size_t>(s)].high) ++s;
    return s;
  };
  for (const auto& s : surfaces) {
    std::vector<std::int32_t> primitives = s.surface.joined;
    primitives.push_back(s.surface.primitive);
    for (const auto p : primitives) {
      result.classes[static_cast<std::size_t>(p)] = s.up ? SurfaceClass::floor : SurfaceClass::ceiling;
      result.storeys[static_cast<std::size_t>(p)] = storey_at(s.height);
    }
  }
  for (const auto& wall : walls)
    for (const auto p : wall.primitives) {
      const Raster& r = footprints[static_cast<std::size_t>(p)].raster;
      result.classes[static_cast<std::size_t>(p)] = SurfaceClass::wall;
      result.storeys[static_cast<std::size_t>(p)] = storey_at((r.low.y() + r.high().y()) / 2);
    }
  return result;
}

}  // namespace

Prisms::Out Prisms::run(const In& in, const Params& params, Context& context) {
  const PlanePrimitives& planes = *in.planes;
  Out out;
  out.cells.origin = planes.cloud->origin;
  out.cells.pixel = fitting_pixel(planes, params.pixel, context);
  constexpr double noise_levels = 3;  // what the noise parts is one surface
  out.cells.noise = mean_residual(planes);
  const double gap = std::max(params.min_gap, noise_levels * out.cells.noise);
  std::vector<Footprint> seen = footprints(planes, out.cells.pixel, context);
  find_open_tops(planes, seen, context);
  lean(planes, out.cells.pixel, seen);
  auto surfaces = level_surfaces(planes, seen, out.cells.pixel,
                                 {params.min_level_area, params.min_level_width, params.min_clearance, gap});
  if (surfaces.empty())
    throw Error("no plane is level: there is neither floor nor ceiling",
                "z must point up (align.z_axis before this node)");
  stand_up(planes, surfaces, out.cells.pixel, seen);
  auto walls = walls_of(planes, seen, surfaces, out.cells.pixel, params);
  join_lines(walls, gap, of_other_storeys);
  std::vector<CellSurface> levels;
  levels.reserve(surfaces.size());
  for (const auto& s : surfaces) levels.push_back(s.surface);
  std::vector<WallLine> lines = walls;
  const auto ridges = meeting_lines(levels, levels, seen);
  lines.insert(lines.end(), ridges.begin(), ridges.end());
  const PrismSpace space = prism_space(planes, seen, std::move(surfaces), lines, out.cells.pixel, out.cells.noise,
                                       params.margin, params.extension, params.reach, context);
  WallCover cover(space, planes, seen);
  auto inside = inside_prisms(space, cover,
                              {params.ceiling_weight, params.floor_weight, params.outside_weight, params.wall_weight,
                               params.smoothness, params.complexity});
  out.cells.storeys = prism_rooms(space, cover, std::move(inside), {params.min_area, params.min_cover}, context);
  out.structure = structure_of(in, seen, space.surfaces, walls, out.cells.storeys);
  if (out.cells.storeys.empty()) {
    context.info("no prism is inside: there is no room");
    out.cells.storeys.push_back(space.plan);
  }
  context.info(fmt::format("{}, {}, {}, {}; {}", counted(space.surfaces.size(), "surface"),
                           counted(lines.size(), "line"), counted(space.plan.cells.size(), "cell"),
                           counted(prisms_of(space), "prism"), counted(out.cells.storeys.size(), "storey")));
  return out;
}

}  // namespace atrium::layout
