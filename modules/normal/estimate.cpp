#include "modules/normal/estimate.hpp"

#include <fmt/format.h>

#include <numeric>

#include "graph/api/text.hpp"
#include "modules/normal/local_plane.hpp"

namespace atrium::normal {
namespace {

/// To the side of `before` (the normals that the cloud had); without it, to the positive side of the largest component.
void choose_sides(const std::vector<Eigen::Vector3f>& before, std::vector<Eigen::Vector3f>& normals,
                  const Context& context) {
  context.parallel_for(normals.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Index largest = 0;
      normals[i].cwiseAbs().maxCoeff(&largest);
      const float side = before.empty() ? normals[i][largest] : normals[i].dot(before[i]);
      if (side < 0) normals[i] = -normals[i];
    }
  });
}

}  // namespace

Estimate::Out Estimate::run(const In& in, const Params& params, Context& context) {
  const std::vector<Eigen::Vector3f>& points = in.cloud->points;
  std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::UnitZ());
  std::vector<std::uint32_t> missing;
  if (points.size() < 3) {
    if (!points.empty())
      context.warn(
          fmt::format("a cloud of {} has no surface: its normals are set to +z", counted(points.size(), "point")));
  } else if (params.method == Method::neighbours) {
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    neighbour_normals(points, static_cast<std::size_t>(params.neighbours), all, normals, context);
  } else {
    normals = params.method == Method::voxels ? voxel_normals(points, params.voxel, missing, context)
                                              : radius_normals(points, params.radius, missing, context);
    neighbour_normals(points, 16, missing, normals, context);
    if (!missing.empty())
      context.info(fmt::format("{} of {} points stand alone: their normals come from their 16 nearest points",
                               missing.size(), points.size()));
  }
  choose_sides(in.cloud->normals, normals, context);
  Out out{*in.cloud};
  out.cloud.normals = std::move(normals);
  return out;
}

}  // namespace atrium::normal
