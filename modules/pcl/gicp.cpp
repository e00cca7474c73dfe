#include "modules/pcl/gicp.hpp"

#include <numbers>

#include "modules/register/pcl_gicp.hpp"

namespace atrium::pcl_nodes {

Gicp::Out Gicp::run(const In& in, const Params& params, Context& context) {
  registration::GicpSettings settings;
  settings.max_distance = params.max_correspondence_distance;
  settings.iterations = static_cast<int>(params.iterations);
  settings.translation_epsilon = params.translation_epsilon;
  settings.rotation_epsilon = params.rotation_epsilon * std::numbers::pi / 180;
  settings.neighbours = static_cast<int>(params.neighbours);
  settings.optimizer_iterations = static_cast<int>(params.optimizer_iterations);
  auto scans = registration::register_scans(
      in.clouds, {params.voxel, params.max_correspondence_distance, params.initial, "GICP"},
      [&](const auto& source, const auto& target) { return registration::align_gicp(source, target, settings); },
      context);
  return {std::move(scans.cloud), std::move(scans.poses), std::move(scans.metrics)};
}

}  // namespace atrium::pcl_nodes
