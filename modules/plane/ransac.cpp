#include "modules/plane/ransac.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "modules/plane/assignment.hpp"
#include "modules/plane/local_spacing.hpp"
#include "modules/plane/plane_search.hpp"

namespace atrium::plane {
namespace {

void check(const Cloud& cloud) {
  if (cloud.size() < 3)
    throw Error("a plane needs at least 3 points, the cloud has " + std::to_string(cloud.size()),
                "look at what the nodes before this one have filtered away");
  if (!cloud.has_normals())
    throw Error(
        "the cloud has no normals",
        "put normal.estimate and normal.orient before this node, or use plane.region_growing, which needs none");
}

}  // namespace

Ransac::Out Ransac::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  check(cloud);
  PlaneSearch::Settings settings;
  settings.tolerance = {static_cast<float>(params.distance),
                        static_cast<float>(std::cos(params.normal_angle * std::numbers::pi / 180))};
  settings.probability = params.probability;
  settings.max_planes = static_cast<std::size_t>(params.max_planes);
  settings.min_points = params.min_points > 0 ? static_cast<std::size_t>(std::max(3, params.min_points))
                                              : std::max<std::size_t>(50, cloud.size() / 2000);

  const MortonOrder order(cloud, params.distance / 2, context, MortonOrder::Normals::yes);
  const PointOctree octree(order.columns, order.codes, octree_leaf_size, context);
  const LocalSpacing spacing(order, context);
  const Connectivity connectivity{spacing, params.cluster_distance};
  const std::vector<Patch> patches = PlaneSearch(order, connectivity, settings, context).run();
  Assignment assignment(cloud.size());
  assignment.add(order, octree, patches, 0, settings.tolerance, context);
  return {fit_primitives(in.cloud, order, assignment.owner, patches, settings.min_points, context)};
}

}  // namespace atrium::plane
