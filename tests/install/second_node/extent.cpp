#include "extent.hpp"

#include <Eigen/Geometry>

namespace atrium::example {

Extent::Out Extent::run(const In& in, const Params& /*params*/, Context& /*context*/) {
  if (in.cloud->points.empty()) throw Error("the cloud has no points", "an extent needs one at least");
  Eigen::AlignedBox3f box;
  for (const auto& p : in.cloud->points) box.extend(p);
  const Eigen::Vector3d size = box.sizes().cast<double>();
  return {{{{"extent.x", size.x(), "m"}, {"extent.y", size.y(), "m"}, {"extent.z", size.z(), "m"}}}};
}

}  // namespace atrium::example
