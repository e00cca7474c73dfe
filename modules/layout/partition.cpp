#include "modules/layout/partition.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "modules/layout/coverage.hpp"
#include "modules/layout/storey_planes.hpp"

namespace atrium::layout {
namespace {

Eigen::AlignedBox2d extent_of(const StoreyPlanes& planes, const std::vector<Footprint>& footprints) {
  Eigen::AlignedBox2d box;
  for (const auto* surfaces : {&planes.floors, &planes.ceilings})
    for (const auto& s : *surfaces) {
      if (s.primitive < 0) continue;
      const Raster& r = footprints[static_cast<std::size_t>(s.primitive)].raster;
      box.extend(r.low);
      box.extend(r.high());
    }
  for (const auto& wall : planes.lines) {
    const Eigen::Vector2d foot = -wall.line.offset * wall.line.normal;
    box.extend(foot + wall.begin * wall.line.along());
    box.extend(foot + wall.end * wall.line.along());
  }
  return box;
}

double area_of(const std::vector<Eigen::Vector2d>& vertices, const std::vector<std::uint32_t>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d a = vertices[corners[i]] - vertices[corners[0]];
    const Eigen::Vector2d b = vertices[corners[(i + 1) % corners.size()]] - vertices[corners[0]];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

void take_cells(const Arrangement& arrangement, StoreyCells& storey) {
  storey.vertices = arrangement.vertices();
  std::unordered_map<std::uint64_t, std::uint32_t> edges;  // by their vertices
  for (const auto& source : arrangement.cells()) {
    const auto index = static_cast<std::int32_t>(storey.cells.size());
    LayoutCell cell;
    cell.corners = source.corners;
    cell.area = area_of(storey.vertices, cell.corners);
    for (std::size_t i = 0; i < source.corners.size(); ++i) {
      const std::uint32_t a = source.corners[i];
      const std::uint32_t b = source.corners[(i + 1) % source.corners.size()];
      const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
      const auto [it, is_new] = edges.emplace(key, static_cast<std::uint32_t>(storey.edges.size()));
      if (is_new) {
        storey.edges.push_back({a, b, index, -1, source.lines[i]});
      } else {
        CellEdge& edge = storey.edges[it->second];
        (edge.from == a ? edge.left : edge.right) = index;
        edge.line = std::max(edge.line, source.lines[i]);
      }
      cell.edges.push_back(it->second);
    }
    storey.cells.push_back(std::move(cell));
  }
}

/// The sides of the box are lines too, for rooms that nothing ends before.
void add_border(const Eigen::AlignedBox2d& box, StoreyCells& storey) {
  const auto first = static_cast<std::int32_t>(storey.lines.size());
  for (int side = 0; side < 4; ++side)
    storey.lines.push_back({Eigen::Vector2d::Unit(side / 2), -(side % 2 == 0 ? box.min() : box.max())[side / 2], {}});
  for (auto& edge : storey.edges) {
    if (edge.line >= 0) continue;
    const Eigen::Vector2d middle = (storey.vertices[edge.from] + storey.vertices[edge.to]) / 2;
    const auto off = [&](std::int32_t line) {
      const CellLine& l = storey.lines[static_cast<std::size_t>(line)];
      return std::abs(l.normal.dot(middle) + l.offset);
    };
    edge.line = first;
    for (std::int32_t line = first + 1; line < first + 4; ++line)
      if (off(line) < off(edge.line)) edge.line = line;
  }
}

StoreyCells cut_storey(const StoreyPlanes& planes, const std::vector<Footprint>& footprints,
                       const Partition::Params& params) {
  constexpr double tolerance = 1e-3;
  constexpr double ridge_extension = 0.5;
  StoreyCells storey;
  storey.low = planes.low;
  storey.high = planes.high;
  storey.floor_height = planes.floor_height;
  storey.ceiling_height = planes.ceiling_height;
  storey.floors = planes.floors;
  storey.ceilings = planes.ceilings;
  const Eigen::AlignedBox2d box = extent_of(planes, footprints);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(params.margin);
  const Eigen::AlignedBox2d wide(box.min() - margin, box.max() + margin);
  Arrangement arrangement(wide.min(), wide.max(), tolerance);
  for (std::size_t i = 0; i < planes.lines.size(); ++i) {
    const WallLine& wall = planes.lines[i];
    storey.lines.push_back({wall.line.normal, wall.line.offset, wall.primitives});
    const double extension = wall.primitives.empty() ? ridge_extension : params.extension;
    arrangement.cut(static_cast<std::int32_t>(i), wall.line, wall.begin - extension, wall.end + extension);
  }
  take_cells(arrangement, storey);
  add_border(wide, storey);
  return storey;
}

}  // namespace

Partition::Out Partition::run(const In& in, const Params& params, Context& context) {
  const PlanePrimitives& planes = *in.structure->primitives;
  Out out;
  out.cells.origin = planes.cloud->origin;
  out.cells.pixel = fitting_pixel(planes, params.pixel, context);
  const std::vector<Footprint> seen = footprints(planes, out.cells.pixel, context);
  // What the noise parts is one surface.
  constexpr double noise_levels = 3;
  out.cells.noise = mean_residual(planes);
  const double gap = std::max(params.min_gap, noise_levels * out.cells.noise);
  for (const auto& storey : storey_planes(*in.structure, seen, gap)) {
    context.check_cancelled();
    out.cells.storeys.push_back(cut_storey(storey, seen, params));
  }
  context.parallel_for(
      out.cells.storeys.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s)
          measure_coverage(*in.structure, seen, out.cells.pixel, out.cells.storeys[s]);
      },
      1);
  std::size_t cells = 0, lines = 0;
  for (const auto& storey : out.cells.storeys) {
    cells += storey.cells.size();
    lines += storey.lines.size();
  }
  context.info(fmt::format("{} storeys, {} lines, {} cells; squares of {:.0f} mm", out.cells.storeys.size(), lines,
                           cells, 1000 * out.cells.pixel));
  return out;
}

}  // namespace atrium::layout
