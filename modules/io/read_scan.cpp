#include "modules/io/read_scan.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/api/text.hpp"
#include "modules/geometry/poisson_disk.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/duplicates.hpp"
#include "modules/io/image_view.hpp"
#include "modules/io/scan_files.hpp"
#include "modules/io/thin_scan.hpp"
#include "modules/io/unit_guess.hpp"

namespace atrium::io {
namespace {

/// The place that the file names; the file's zero if it is an image of points that was taken from there.
std::optional<Eigen::Vector3d> viewpoint_of(const RawGeometry& geometry, const Cloud& cloud, const Context& context) {
  const Eigen::Vector3d viewpoint = geometry.viewpoint.value_or(Eigen::Vector3d::Zero());
  if (!viewpoint.allFinite()) return std::nullopt;
  if (!viewpoint.isZero(0)) return viewpoint;
  if (geometry.image_width == 0) return std::nullopt;
  if (cloud.origin.isZero(0) && is_image_from(geometry, viewpoint)) return viewpoint;
  context.warn(
      geometry.path +
      ": seen from zero, the viewpoint in the file, its points are no image: they may be in the frame of a map. "
      "Where the scanner stood is taken to be not known; the parameter `sensor: origin` puts it at zero");
  return std::nullopt;
}

void set_sensor(const RawGeometry& geometry, const ReadScan::Params& params, double scale, Cloud& cloud,
                const Context& context) {
  if (params.sensor == ReadScan::SensorUse::automatic && !cloud.sensors.empty()) return;  // several, with sources
  cloud.sensors.clear();
  cloud.source.clear();
  std::optional<Eigen::Vector3d> place;
  if (params.sensor == ReadScan::SensorUse::origin) place = Eigen::Vector3d::Zero();
  if (params.sensor == ReadScan::SensorUse::automatic) {
    place = viewpoint_of(geometry, cloud, context);
    if (place) *place *= scale;
  }
  if (place) cloud.sensors = {(*place - cloud.origin).cast<float>()};
}

std::string sizes_of(const Eigen::Vector3f& extent, double factor) {
  const Eigen::Vector3d size = extent.cast<double>() * factor;
  return fmt::format("{:.3g} × {:.3g} × {:.3g} m", size.x(), size.y(), size.z());
}

/// What is far larger than an interior, or smaller than a room, is in another unit than was taken.
void hint_at_unit(const std::string& path, const Cloud& cloud, bool forced, const Context& context) {
  constexpr float large = 500.0F;  // metres: no interior is longer, but 500 mm is less than any room
  constexpr float low = 2.5F;      // metres: a room is higher or longer
  constexpr float small = 2.0F;    // cubic metres
  constexpr std::size_t few = 500;
  const Eigen::Vector3f extent = bounds_of(cloud.points, context).extent();
  if (extent.maxCoeff() > large)
    context.warn(
        fmt::format("{}: the extent is {:.0f} × {:.0f} × {:.0f} m: if these are centimetres, set unit: cm (then "
                    "it is {}); if these are millimetres, set unit: mm ({})",
                    path, extent.x(), extent.y(), extent.z(), sizes_of(extent, 0.01), sizes_of(extent, 0.001)));
  else if (!forced && cloud.size() >= few && extent.maxCoeff() > 0 && extent.maxCoeff() < low && extent.prod() < small)
    context.warn(
        fmt::format("{}: the extent is {}, less than a room's: if the file is in another unit or in none, set "
                    "scale (metres per unit)",
                    path, sizes_of(extent, 1)));
}

double metres_per(ReadScan::Unit unit) {
  switch (unit) {
    case ReadScan::Unit::centimetre: return 0.01;
    case ReadScan::Unit::millimetre: return 0.001;
    case ReadScan::Unit::inch: return 0.0254;
    case ReadScan::Unit::foot: return 0.3048;
    default: return 1.0;
  }
}

/// Metres per unit of the file: as it is set, as the format fixes it, or as the scan shows; says so.
double unit_of(const RawGeometry& geometry, const ReadScan::Params& params, const Cloud& unscaled,
               const Context& context) {
  if (params.scale != 1.0) return 1.0;
  if (geometry.metres_per_unit) {
    const double metres = *geometry.metres_per_unit;
    if (metres != 1.0)
      context.warn(fmt::format("{}: its unit is {:.7g} m, as the file says; -s scan.unit=m forces metres",
                               geometry.path, metres));
    return metres;
  }
  const UnitGuess guess = guess_unit(unscaled.points, geometry.y_up, context);
  if (!guess.warning.empty())
    context.warn(fmt::format("{}: {}", geometry.path, guess.warning));
  else
    context.info(fmt::format("{}: taken to be in metres{}", geometry.path, guess.reason));
  return guess.metres;
}

/// Once, for all that is made of the scan (crs_of).
void warn_of_other_unit(const std::string& path, const Cloud& cloud, const Context& context) {
  if (!cloud.crs.empty() && cloud.unit != 1)
    context.warn(
        fmt::format("{}: its coordinate reference system counts in units of {:.7g} m: results, which are in "
                    "metres, do not name it",
                    path, cloud.unit));
}

void warn_of_duplicates(const std::string& path, const Cloud& cloud, const Context& context) {
  if (const std::size_t places = few_places(cloud.points); places > 0) {
    const Eigen::Vector3d first = cloud.origin + cloud.points.front().cast<double>();
    context.warn(
        fmt::format("{}: all {} points lie in {}, the first at {:g} {:g} {:g}: was the file written or copied to "
                    "its end?",
                    path, cloud.size(), places == 1 ? "one place" : fmt::format("{} places", places), first.x(),
                    first.y(), first.z()));
    return;
  }
  const double share = duplicate_share(cloud.points, context);
  if (share > 0.1)
    context.warn(fmt::format("{}: about {:.0f} % of the points lie exactly on others; filter.voxel_grid joins them",
                             path, 100.0 * share));
}

double surface_of(const Mesh& mesh) {
  double twice = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    twice += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return twice / 2;
}

std::size_t samples_of(const Mesh& mesh, const ReadScan::Params& params) {
  constexpr double most = 4e9;
  if (params.samples > 0) return static_cast<std::size_t>(params.samples);
  if (params.spacing == 0) return mesh.vertices.size();
  return static_cast<std::size_t>(std::min(most, std::ceil(surface_of(mesh) / (params.spacing * params.spacing))));
}

Cloud sample(const RawGeometry& geometry, const ReadScan::Params& params, double scale, const Context& context) {
  const Mesh mesh = decode_mesh(geometry, scale, context);
  const std::size_t wanted = samples_of(mesh, params);
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

ReadScan::Out ReadScan::run(const Params& params, Context& context) {
  std::vector<std::string> paths;
  paths.reserve(params.path.size());
  for (const auto& given : params.path) paths.push_back(given.path);
  RawGeometry geometry = read_scan_files(paths, context);
  const std::string& path = geometry.path;
  const bool sampled = params.mesh == MeshUse::sample && !geometry.triangles.empty();
  const bool thin = params.voxel > 0 && !sampled && geometry.count > static_cast<std::size_t>(params.voxel_above);
  if (!thin) load_rows(geometry, context);
  const auto decoded = [&](double scale) {
    if (sampled) return sample(geometry, params, scale, context);
    return thin ? thinned(geometry, scale, params.voxel, params.voxel_share, context)
                : decode_cloud(geometry, scale, context);
  };
  const bool known = params.unit != Unit::automatic;
  double scale = params.scale * (known ? metres_per(params.unit) : 1.0);
  if (thin && !known) scale *= unit_of(geometry, params, sample_of(geometry, context), context);
  Cloud cloud = decoded(scale);
  if (!thin && !known) {
    const double unit = unit_of(geometry, params, cloud, context);
    if (unit != 1.0) cloud = decoded(scale *= unit);
  }
  cloud.unit = scale;
  cloud.y_up = geometry.y_up;
  cloud.crs = geometry.crs;
  warn_of_other_unit(path, cloud, context);
  set_sensor(geometry, params, scale, cloud, context);
  warn_of_lost_digits(geometry, cloud.origin, scale, context);
  hint_at_unit(path, cloud, params.scale != 1.0 || (known && params.unit != Unit::metre), context);
  if (thin && params.voxel_above > 0)
    context.warn(
        fmt::format("{}: {} points become {}, one for each {:.6g} m voxel: noise that is measured against them "
                    "is that of these means; `voxel: 0` keeps all points",
                    path, geometry.count, cloud.size(), params.voxel));
  if (!thin)
    warn_of_duplicates(path, cloud, context);
  else if (cloud.size() < 3)
    context.warn(fmt::format("{}: all points lie in {} of {} m", path, counted(cloud.size(), "voxel"), params.voxel));
  return {std::move(cloud)};
}

}  // namespace atrium::io
