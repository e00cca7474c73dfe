#include "modules/filter/crop.hpp"

#include <fmt/format.h>

#include "modules/filter/kept.hpp"

namespace atrium::filter {

Crop::Out Crop::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  if (params.min.size() != 3 || params.max.size() != 3) throw Error("min and max of the box are x, y and z");
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (params.min[axis] > params.max[axis])
      throw Error(fmt::format("the box to crop has its {} from {:g} m to {:g} m", "xyz"[axis], params.min[axis],
                              params.max[axis]),
                  "min must not exceed max");
  const Eigen::Array3d low(params.min[0], params.min[1], params.min[2]);
  const Eigen::Array3d high(params.max[0], params.max[1], params.max[2]);
  std::vector<std::uint8_t> keep(cloud.size());
  context.parallel_for(cloud.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Array3d at = cloud.origin + cloud.points[i].cast<double>();
      const bool inside = (at >= low).all() && (at <= high).all();
      keep[i] = inside == (params.keep == Keep::inside) ? 1 : 0;
    }
  });
  Out out{kept(cloud, keep)};
  if (out.cloud.size() == 0 && cloud.size() > 0)
    context.warn(
        fmt::format("none of the {} points is left; the box is in true coordinates, the cloud's origin ({:g}, {:g}, "
                    "{:g}) included",
                    cloud.size(), cloud.origin.x(), cloud.origin.y(), cloud.origin.z()));
  return out;
}

}  // namespace atrium::filter
