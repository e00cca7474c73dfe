#include "modules/register/register_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/api/text.hpp"
#include "modules/geometry/point_grid.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/register/join_clouds.hpp"

namespace atrium::registration {
namespace {

/// Where the i-th scan's points are to start, as a motion of true coordinates.
Eigen::Isometry3d initial_pose(const std::vector<double>& initial, std::size_t i) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (initial.empty()) return pose;
  const double* v = initial.data() + 4 * (i - 1);
  pose.linear() = Eigen::AngleAxisd(v[3] * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

void report(std::size_t i, const Fitness& fit, bool converged, const std::string& method, Metrics& metrics,
            const Context& context) {
  const std::string name = fmt::format("register.{}.", i);
  metrics.values.push_back({name + "overlap", fit.overlap, ""});
  metrics.values.push_back({name + "median_distance", fit.median, "m"});
  metrics.values.push_back({name + "rms", fit.rms, "m"});
  if (!converged)
    context.warn(fmt::format("scan {}: {} did not converge; allow more iterations or give a better start", i, method));
  if (fit.overlap < 0.2)
    context.warn(fmt::format("scan {} overlaps those before it by {:.0f} % only: its pose is not to be trusted", i,
                             100 * fit.overlap));
}

}  // namespace

Points thinned(const Points& points, double voxel, const Context& context) {
  const PointGrid grid(points, voxel, context);
  Points result;
  for (const auto& cell : grid.cells()) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::uint32_t i = cell.begin; i < cell.end; ++i) sum += grid.points()[i].cast<double>();
    result.push_back((sum / cell.size()).cast<float>());
  }
  return result;
}

Points moved(const Points& points, const Eigen::Isometry3d& motion) {
  Points result;
  result.reserve(points.size());
  for (const auto& p : points) result.push_back((motion * p.cast<double>()).cast<float>());
  return result;
}

Fitness fitness_of(const Points& source, const PointTree& target, double reach) {
  std::vector<double> distances;
  double squares = 0;
  for (const auto& p : source) {
    Neighbour n;
    if (!target.nearest(p, n, static_cast<float>(reach))) continue;
    distances.push_back(std::sqrt(static_cast<double>(n.squared_distance)));
    squares += static_cast<double>(n.squared_distance);
  }
  if (distances.empty()) return {};
  const auto n = static_cast<double>(distances.size());
  return {n / static_cast<double>(source.size()), median(std::move(distances)), std::sqrt(squares / n)};
}

RegisteredScans register_scans(const Inputs<Cloud>& clouds, const RegisterSettings& settings, const AlignPair& align,
                               Context& context) {
  const std::size_t scans = clouds.size();
  if (!settings.initial.empty() && settings.initial.size() != 4 * (scans - 1))
    throw Error(
        fmt::format("{} in `initial` for {}", counted(settings.initial.size(), "number"), counted(scans, "scan")),
        "x y z yaw for each scan after the first");
  const Eigen::Vector3d origin = clouds.front()->origin;
  RegisteredScans out;
  Points target, dense;  // what was registered so far, thinned for GICP and for measuring
  for (std::size_t i = 0; i < scans; ++i) {
    const Cloud& cloud = *clouds[i];
    const Eigen::Isometry3d start =
        Eigen::Translation3d(-origin) * (i == 0 ? Eigen::Isometry3d::Identity() : initial_pose(settings.initial, i));
    const Eigen::Isometry3d to_start = start * Eigen::Translation3d(cloud.origin);
    const Points points = moved(thinned(cloud.points, settings.voxel, context), to_start);
    if (points.size() < least_registered && scans > 1)
      throw Error(fmt::format("scan {} has {} points after thinning: too few to register", i, points.size()),
                  fmt::format("at least {} are needed; a smaller voxel keeps more", least_registered));
    PairMotion found;
    if (i > 0) {
      found = align(points, target);
      report(i, fitness_of(moved(points, found.motion), PointTree(dense, context), settings.reach), found.converged,
             settings.method, out.metrics, context);
    }
    const Points fine = moved(thinned(cloud.points, settings.voxel / 4, context), found.motion * to_start);
    dense.insert(dense.end(), fine.begin(), fine.end());
    const Points placed = moved(points, found.motion);
    target.insert(target.end(), placed.begin(), placed.end());
    target = thinned(target, settings.voxel, context);
    const Eigen::Isometry3d pose = Eigen::Translation3d(origin) * found.motion * start;
    out.poses.transforms.push_back({pose.linear(), pose.translation()});
    context.progress(static_cast<double>(i + 1) / static_cast<double>(scans));
  }
  out.cloud = join(clouds, out.poses, context);
  return out;
}

}  // namespace atrium::registration
