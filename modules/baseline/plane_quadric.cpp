#include "modules/baseline/plane_quadric.hpp"

#include <fmt/format.h>

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
  Out out;
  bool too_far = false;
  out.mesh = collapsed_by_planes(mesh, neighbours, partition, limits, context, too_far);
  out.planes = static_cast<std::int64_t>(partition.planes.size());
  if (target > 0 && out.mesh.triangles.size() > target)
    context.warn(fmt::format("{} triangles are left, {} were wanted: {}", out.mesh.triangles.size(), target,
                             too_far ? "the rest would move further than 'max_error' lets it"
                                     : "the rest are borders and corners of planes, or hold the topology"));
  return out;
}

}  // namespace atrium::baseline
