#include "modules/register/gicp.hpp"

#include <algorithm>
#include <numbers>

#include "modules/geometry/point_tree.hpp"
#include "modules/register/pcl_gicp.hpp"
#include "modules/register/register_scans.hpp"
#include "modules/register/yaw_search.hpp"

namespace atrium::registration {
namespace {

constexpr std::size_t coarse_starts = 6;

class Registration {
 public:
  Registration(const Gicp::Params& params, const Context& context) : params_(params), context_(context) {}

  /// From where `source` stands to the target.
  PairMotion align(const Points& source, const Points& target) const {
    const Eigen::Isometry3d start =
        params_.coarse == Coarse::yaw_search ? best_start(source, target) : Eigen::Isometry3d::Identity();
    PairMotion result = align_gicp(moved(source, start), target, settings());
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
    if (std::min(source.size(), target.size()) < least_registered) return starts.front();
    const PointTree tree(all_target, context_);
    GicpSettings brief = settings();
    brief.iterations = std::min(brief.iterations, 10);
    Eigen::Isometry3d best = starts.front();
    double most = -1;
    for (const auto& start : starts) {
      context_.check_cancelled();
      const Eigen::Isometry3d motion = align_gicp(moved(source, start), target, brief).motion * start;
      const double share = fitness_of(moved(all_source, motion), tree, params_.voxel).overlap;
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

}  // namespace

Gicp::Out Gicp::run(const In& in, const Params& params, Context& context) {
  const Registration registration(params, context);
  RegisteredScans scans = register_scans(
      in.clouds, {params.voxel, params.max_correspondence_distance, params.initial, "GICP"},
      [&](const Points& source, const Points& target) { return registration.align(source, target); }, context);
  return {std::move(scans.cloud), std::move(scans.poses), std::move(scans.metrics)};
}

}  // namespace atrium::registration
