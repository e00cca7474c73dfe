#include "modules/io/read_scan.hpp"

#include <fmt/format.h>

#include "modules/geometry/poisson_disk.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/duplicates.hpp"
#include "modules/io/read_geometry.hpp"

namespace atrium::io {
namespace {

void set_sensor(const RawGeometry& geometry, const ReadScan::Params& params, Cloud& cloud) {
  if (params.sensor == ReadScan::SensorUse::automatic && !cloud.sensors.empty()) return;  // several, with sources
  cloud.sensors.clear();
  cloud.source.clear();
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

void warn_of_duplicates(const std::string& path, const Cloud& cloud, const Context& context) {
  const double share = duplicate_share(cloud.points, context);
  if (share > 0.1)
    context.warn(fmt::format("{}: about {:.0f} % of the points lie exactly on others; filter.voxel_grid joins them",
                             path, 100.0 * share));
}

/// As many samples as the mesh has vertices, unless the parameter says how many.
Cloud sample(const RawGeometry& geometry, const ReadScan::Params& params, const Context& context) {
  const Mesh mesh = decode_mesh(geometry, params.scale, context);
  const std::size_t wanted = params.samples > 0 ? static_cast<std::size_t>(params.samples) : mesh.vertices.size();
  if (wanted < 3) throw Error(fmt::format("{}: {} samples of the mesh", geometry.path, wanted), "three are the least");
  if (mesh.triangles.empty())
    throw Error(geometry.path + ": none of the mesh's triangles has finite corners", "mesh: vertices reads its points");
  try {
    return sample_poisson_disk(mesh, wanted, context);
  } catch (const Error& error) {
    throw Error(geometry.path + ": " + error.what(), error.help());
  }
}

}  // namespace

ReadScan::Out ReadScan::run(const In& /*in*/, const Params& params, Context& context) {
  const std::string& path = params.path.path;
  const RawGeometry geometry = read_geometry(path, context);
  const bool sampled = params.mesh == MeshUse::sample && !geometry.triangles.empty();
  Cloud cloud = sampled ? sample(geometry, params, context) : decode_cloud(geometry, params.scale, context);
  set_sensor(geometry, params, cloud);
  hint_at_unit(path, cloud, context);
  warn_of_duplicates(path, cloud, context);
  return {std::move(cloud)};
}

}  // namespace atrium::io
