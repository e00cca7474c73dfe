#include "modules/pcl/poisson.hpp"

#include <limits>

#include "modules/object/pcl_surfaces.hpp"

namespace atrium::pcl_nodes {

Poisson::Out Poisson::run(const In& in, const Params& params, Context& context) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  if (!object::is_surface(*in.cloud, context)) return out;
  const object::PoissonSettings settings{static_cast<int>(params.depth), params.samples_per_node, params.point_weight,
                                         params.scale, params.confidence};
  out.mesh = object::finished(object::poisson_surface(*in.cloud, settings), *in.cloud,
                              std::numeric_limits<float>::infinity(), context);
  return out;
}

}  // namespace atrium::pcl_nodes
