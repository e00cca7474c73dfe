#include "modules/register/gicp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/point_grid.hpp"
#include "modules/geometry/point_tree.hpp"
#include "modules/register/join_clouds.hpp"
#include "modules/register/pcl_gicp.hpp"
#include "modules/register/yaw_search.hpp"

namespace atrium::registration {
namespace {

using Points = std::vector<Eigen::Vector3f>;
constexpr std::size_t min_points = 30;
constexpr std::size_t coarse_starts = 6;

/// One point per voxel.
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

struct Fitness {
  double overlap = 0, median = 0, rms = 0;
};

Fitness fitness(const Points& source, const PointTree& target, double reach) {
  std::vector<double> distances;
  double squares = 0;
  for (const auto& p : source) {
    Neighbour n;
    if (!target.nearest(p, n, static_cast<float>(reach))) continue;
    distances.push_back(std::sqrt(static_cast<double>(n.squared_distance)));
    squares += static_cast<double>(n.squared_distance);
  }
  if (distances.empty()) return {};
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  const auto n = static_cast<double>(distances.size());
  return {n / static_cast<double>(source.size()), *middle, std::sqrt(squares / n)};
}

/// Where the i-th scan's points are to start, as a motion of true coordinates.
Eigen::Isometry3d initial_pose(const std::vector<double>& initial, std::size_t i) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (initial.empty()) return pose;
  const double* v = initial.data() + 4 * (i - 1);
  pose.linear() = Eigen::AngleAxisd(v[3] * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

class Registration {
 public:
  Registration(const Gicp::Params& params, const Context& context) : params_(params), context_(context) {}

  /// From where `source` stands to the target.
  GicpResult align(const Points& source, const Points& target) const {
    const Eigen::Isometry3d start =
        params_.coarse == Coarse::yaw_search ? best_start(source, target) : Eigen::Isometry3d::Identity();
    GicpResult result = align_gicp(moved(source, start), target, settings());
    result.motion = result.motion * start;
    return result;
  }

 private:
  /// The start that a short registration of fewer points brings nearest to the target.
  Eigen::Isometry3d best_start(const Points& all_source, const Points& all_target) const {
    std::vector<Eigen::Isometry3d> starts{Eigen::Isometry3d::Identity()};
    for (const auto& s : search_yaw(all_source, all_target, coarse_starts, context_)) starts.push_back(s);
    const Points source = thinned(all_source, 3 * params_.voxel, context_);
    const Points target = thinned(all_target, 3 * params_.voxel, context_);
    if (std::min(source.size(), target.size()) < min_points) return starts.front();
    const PointTree tree(all_target, context_);
    GicpSettings brief = settings();
    brief.iterations = std::min(brief.iterations, 10);
    Eigen::Isometry3d best = starts.front();
    double most = -1;
    for (const auto& start : starts) {
      context_.check_cancelled();
      const Eigen::Isometry3d motion = align_gicp(moved(source, start), target, brief).motion * start;
      const double share = fitness(moved(all_source, motion), tree, params_.voxel).overlap;
      if (share <= most) continue;
      most = share;
      best = motion;
    }
    return best;
  }
  GicpSettings settings() const {
    return {params_.max_correspondence_distance, static_cast<int>(params_.iterations), params_.translation_epsilon,
            params_.rotation_epsilon * std::numbers::pi / 180};
  }
  const Gicp::Params& params_;
  const Context& context_;
};

void report(std::size_t i, const Fitness& fit, bool converged, Metrics& metrics, const Context& context) {
  const std::string name = fmt::format("register.{}.", i);
  metrics.values.push_back({name + "overlap", fit.overlap, ""});
  metrics.values.push_back({name + "median_distance", fit.median, "m"});
  metrics.values.push_back({name + "rms", fit.rms, "m"});
  if (!converged) context.warn(fmt::format("scan {}: GICP did not converge", i));
  if (fit.overlap < 0.2)
    context.warn(fmt::format("scan {} overlaps those before it by {:.0f} % only: its pose is not to be trusted", i,
                             100 * fit.overlap));
}

}  // namespace

Gicp::Out Gicp::run(const In& in, const Params& params, Context& context) {
  const std::size_t scans = in.clouds.size();
  if (!params.initial.empty() && params.initial.size() != 4 * (scans - 1))
    throw Error(fmt::format("{} numbers in `initial` for {} scans", params.initial.size(), scans),
                "x y z yaw for each scan after the first");
  const Eigen::Vector3d origin = in.clouds.front()->origin;
  Out out;
  Points target, dense;  // what was registered so far, thinned for GICP and for measuring
  const Registration registration(params, context);
  for (std::size_t i = 0; i < scans; ++i) {
    const Cloud& cloud = *in.clouds[i];
    const Eigen::Isometry3d start =
        Eigen::Translation3d(-origin) * (i == 0 ? Eigen::Isometry3d::Identity() : initial_pose(params.initial, i));
    const Eigen::Isometry3d to_start = start * Eigen::Translation3d(cloud.origin);
    const Points points = moved(thinned(cloud.points, params.voxel, context), to_start);
    if (points.size() < min_points && scans > 1)
      throw Error(fmt::format("scan {} has {} points after thinning: too few to register", i, points.size()),
                  fmt::format("at least {} are needed; a smaller voxel keeps more", min_points));
    GicpResult found;
    if (i > 0) {
      found = registration.align(points, target);
      report(i, fitness(moved(points, found.motion), PointTree(dense, context), params.max_correspondence_distance),
             found.converged, out.metrics, context);
    }
    const Points fine = moved(thinned(cloud.points, params.voxel / 4, context), found.motion * to_start);
    dense.insert(dense.end(), fine.begin(), fine.end());
    const Points placed = moved(points, found.motion);
    target.insert(target.end(), placed.begin(), placed.end());
    target = thinned(target, params.voxel, context);
    const Eigen::Isometry3d pose = Eigen::Translation3d(origin) * found.motion * start;
    out.poses.transforms.push_back({pose.linear(), pose.translation()});
    context.progress(static_cast<double>(i + 1) / static_cast<double>(scans));
  }
  out.cloud = join(in.clouds, out.poses, context);
  return out;
}

}  // namespace atrium::registration
