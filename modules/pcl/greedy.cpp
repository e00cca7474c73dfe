#include "modules/pcl/greedy.hpp"

#include <limits>

#include "modules/object/pcl_surfaces.hpp"

namespace atrium::pcl_nodes {

Greedy::Out Greedy::run(const In& in, const Params& params, Context& context) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  if (!object::is_surface(*in.cloud, context)) return out;
  const object::GreedySettings settings{params.search_radius,     params.reach,     params.max_neighbours,
                                        params.max_surface_angle, params.min_angle, params.max_angle,
                                        params.normal_consistency};
  out.mesh = object::finished(object::greedy_surface(*in.cloud, settings), *in.cloud,
                              std::numeric_limits<float>::infinity(), context);
  return out;
}

}  // namespace atrium::pcl_nodes
