#include "modules/normal/orient.hpp"

#include "modules/normal/free_space.hpp"

namespace atrium::normal {
namespace {

const Eigen::Vector3f& sensor_of(const Cloud& cloud, std::size_t i) {
  if (!cloud.source.empty()) return cloud.sensors[cloud.source[i]];
  std::size_t nearest = 0;
  for (std::size_t s = 1; s < cloud.sensors.size(); ++s)
    if ((cloud.sensors[s] - cloud.points[i]).squaredNorm() < (cloud.sensors[nearest] - cloud.points[i]).squaredNorm())
      nearest = s;
  return cloud.sensors[nearest];
}

void towards_sensors(Cloud& cloud, const Context& context) {
  for (const auto s : cloud.source)
    if (s >= cloud.sensors.size())
      throw Error("a point's source is sensor " + std::to_string(s) + ", but the cloud has " +
                  std::to_string(cloud.sensors.size()));
  context.parallel_for(cloud.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (cloud.normals[i].dot(sensor_of(cloud, i) - cloud.points[i]) < 0) cloud.normals[i] = -cloud.normals[i];
  });
}

}  // namespace

Orient::Out Orient::run(const In& in, const Params& params, Context& context) {
  if (in.cloud->size() > 0 && !in.cloud->has_normals())
    throw Error("the cloud has no normals to orient", "estimate them before (normal.estimate)");
  if (params.towards == Towards::sensors && in.cloud->size() > 0 && in.cloud->sensors.empty())
    throw Error("the cloud has no sensor positions", "use towards: inside");
  Out out{*in.cloud};
  if (out.cloud.size() == 0) return out;
  const bool sensors =
      params.towards == Towards::sensors || (params.towards == Towards::automatic && !in.cloud->sensors.empty());
  if (sensors)
    towards_sensors(out.cloud, context);
  else
    turn_to_free_space(out.cloud, params.voxel, params.range, context);
  return out;
}

}  // namespace atrium::normal
