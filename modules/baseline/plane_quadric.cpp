#include "modules/baseline/plane_quadric.hpp"

#include <fmt/format.h>

#include <utility>

#include "modules/baseline/face_neighbours.hpp"
#include "modules/baseline/input_mesh.hpp"
#include "modules/baseline/planar_partition.hpp"
#include "modules/baseline/plane_collapse.hpp"

namespace atrium::baseline {
namespace {

std::size_t target_of(std::size_t count, const PlaneQuadric::Params& params) {
  if (params.triangles <= 0 && params.ratio <= 0 && params.max_error > 0) return 0;
  return target_triangles(count, params.triangles, params.ratio);
}

}  // namespace

PlaneQuadric::Out PlaneQuadric::run(const In& in, const Params& params, Context& context) {
  constexpr double projection = 3;  // of `distance`
  check_mesh(*in.mesh);
  const std::size_t target = target_of(in.mesh->triangles.size(), params);
  const Mesh mesh = without_repeated_corners(*in.mesh);
  const FaceNeighbours neighbours = face_neighbours(mesh, context);
  const PlanarPartition partition =
      planar_partition(mesh, neighbours, {params.distance, params.angle, params.min_area}, context);
  const CollapseLimits limits{target, params.max_error, params.border_weight, projection * params.distance};
  Collapsed collapsed = collapsed_by_planes(mesh, neighbours, partition, limits, context);
  Out out;
  out.planes = static_cast<std::int64_t>(partition.planes.size());
  const std::size_t left = collapsed.mesh.triangles.size();
  if (left > target && target > 0)
    context.warn(fmt::format("{} triangles are left, {} were wanted: {}", left, target,
                             collapsed.too_far ? "the rest would move further than 'max_error' lets it"
                                               : "the rest hold the topology, or would turn triangles over"));
  if (left < collapsed.with_borders)
    context.info(fmt::format("borders of planes were given up from {} triangles on", collapsed.with_borders));
  out.mesh = std::move(collapsed.mesh);
  return out;
}

}  // namespace atrium::baseline
