#include "modules/io/read_scan.hpp"

#include <fmt/format.h>

#include "modules/io/decode.hpp"
#include "modules/io/read_geometry.hpp"

namespace atrium::io {
namespace {

void set_sensor(const RawGeometry& geometry, const ReadScan::Params& params, Cloud& cloud) {
  std::optional<Eigen::Vector3d> place;
  if (params.sensor == ReadScan::SensorUse::origin) place = Eigen::Vector3d::Zero();
  if (params.sensor == ReadScan::SensorUse::automatic) {
    const Eigen::Vector3d viewpoint = geometry.viewpoint.value_or(Eigen::Vector3d::Zero());
    if (viewpoint.allFinite() && (!viewpoint.isZero(0) || geometry.organised)) place = viewpoint * params.scale;
  }
  if (place) cloud.sensors = {(*place - cloud.origin).cast<float>()};
}

void hint_at_unit(const std::string& path, const Cloud& cloud, const Context& context) {
  constexpr float large = 500.0F;  // metres: no interior is longer, but 500 mm is less than any room
  const Eigen::Vector3f extent = bounds_of(cloud.points, context).extent();
  if (extent.maxCoeff() > large)
    context.warn(fmt::format("{}: the extent is {:.0f} × {:.0f} × {:.0f} m: if these are millimetres, set scale: 0.001",
                             path, extent.x(), extent.y(), extent.z()));
}

}  // namespace

ReadScan::Out ReadScan::run(const In& /*in*/, const Params& params, Context& context) {
  const RawGeometry geometry = read_geometry(params.path.path, context);
  Cloud cloud = decode_cloud(geometry, params.scale, context);
  set_sensor(geometry, params, cloud);
  hint_at_unit(params.path.path, cloud, context);
  return {std::move(cloud)};
}

}  // namespace atrium::io
