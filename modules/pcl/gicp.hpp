#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/node.hpp"
#include "modules/register/gicp.hpp"

namespace atrium::pcl_nodes {

/// Brings several scans into the frame of the first by pcl::GeneralizedIterativeClosestPoint alone: swaps with
/// register.gicp, which is the same with a search for start poses before it, and lacks PCL's settings of the method.
/// Thinning, joining, metrics, warnings and errors are as register.gicp's header says. One thread, no random numbers.
struct Gicp {
  static constexpr std::string_view type = "pcl.gicp";
  static constexpr std::string_view summary = "Registers several scans by PCL's Generalized ICP.";
  using In = registration::Gicp::In;
  using Out = registration::Gicp::Out;
  struct Params {
    double max_correspondence_distance = 0.5;
    std::int64_t iterations = 100;
    double translation_epsilon = 1e-4;
    double rotation_epsilon = 0.01;
    std::int64_t neighbours = 20;
    std::int64_t optimizer_iterations = 20;
    double voxel = 0.1;
    std::vector<double> initial;
  };
  static constexpr auto inputs = registration::Gicp::inputs;
  static constexpr auto outputs = registration::Gicp::outputs;
  static constexpr auto params = std::tuple{
      param<&Params::max_correspondence_distance>(metres, within(0.001, 100),
                                                  "Points further apart are never taken for the same place."),
      param<&Params::iterations>(count, within(1, 10000), "At most so many rounds."),
      param<&Params::translation_epsilon>(metres, within(1e-9, 1), "Ends when a round moves the scan by less."),
      param<&Params::rotation_epsilon>(degrees, within(1e-6, 10), "Ends when a round turns the scan by less."),
      param<&Params::neighbours>(count, within(4, 1000),
                                 "Nearest points that give a point its covariance (PCL's correspondence randomness)."),
      param<&Params::optimizer_iterations>(count, within(1, 10000), "Steps of the optimizer in a round."),
      param<&Params::voxel>(metres, within(0.001, 10), "Spacing of the points that are registered."),
      param<&Params::initial>(
          unitless, unbounded,
          "Start poses: x y z (m) and yaw (deg about z) for each scan after the first. Empty: all stand alike.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
