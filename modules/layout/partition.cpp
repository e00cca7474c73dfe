#include "modules/layout/partition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/text.hpp"
#include "modules/layout/ceilings_behind.hpp"
#include "modules/layout/coverage.hpp"
#include "modules/layout/plan_cells.hpp"
#include "modules/layout/storey_planes.hpp"

namespace atrium::layout {
namespace {

StoreyCells cut_storey(const StoreyPlanes& planes, const std::vector<Footprint>& footprints,
                       const Partition::Params& params) {
  constexpr double tolerance = 1e-3;
  constexpr double ridge_extension = 0.5;
  StoreyCells storey;
  storey.low = planes.low;
  storey.high = planes.high;
  storey.floor_height = planes.floor_height;
  storey.ceiling_height = planes.ceiling_height;
  storey.wall_end = planes.wall_end;
  storey.floors = planes.floors;
  storey.ceilings = planes.ceilings;
  const Eigen::AlignedBox2d box = extent_of({&planes.floors, &planes.ceilings}, planes.lines, footprints);
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
  std::vector<Footprint> seen = footprints(planes, out.cells.pixel, context);
  find_open_tops(planes, seen, context);
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
  context.info(fmt::format("{}, {}, {}; squares of {:.0f} mm", counted(out.cells.storeys.size(), "storey"),
                           counted(lines, "line"), counted(cells, "cell"), 1000 * out.cells.pixel));
  return out;
}

}  // namespace atrium::layout
