#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/node.hpp"
#include "modules/register/gicp.hpp"

namespace atrium::pcl_nodes {

/// Brings several scans into the frame of the first by the normal distributions transform (Magnusson 2009,
/// pcl::NormalDistributionsTransform): swaps with register.gicp. The scans before are a grid of Gaussians, and the next
/// one is moved to where its points are likeliest. It takes start poses that are further off than GICP does, and ends
/// less exactly: the result of one may be the start of the other.
///
/// Thinning, joining, metrics, warnings and errors are as register.gicp's header says. One thread, no random numbers.
struct Ndt {
  static constexpr std::string_view type = "pcl.ndt";
  static constexpr std::string_view summary = "Registers several scans by the normal distributions transform (PCL).";
  using In = registration::Gicp::In;
  using Out = registration::Gicp::Out;
  struct Params {
    double resolution = 0.5;
    double step_size = 0.1;
    double outlier_ratio = 0.55;
    std::int64_t iterations = 100;
    double translation_epsilon = 1e-3;
    double max_correspondence_distance = 0.5;
    double voxel = 0.1;
    std::vector<double> initial;
  };
  static constexpr auto inputs = registration::Gicp::inputs;
  static constexpr auto outputs = registration::Gicp::outputs;
  static constexpr auto params = std::tuple{
      param<&Params::resolution>(metres, within(0.01, 100), "Edge of a cell of the grid: several times `voxel`."),
      param<&Params::step_size>(metres, within(1e-4, 10), "Longest step of the line search."),
      param<&Params::outlier_ratio>(ratio, within(0, 0.99), "Share of points that are expected to match nothing."),
      param<&Params::iterations>(count, within(1, 10000), "At most so many steps."),
      param<&Params::translation_epsilon>(metres, within(1e-9, 1), "Ends when a step is shorter."),
      param<&Params::max_correspondence_distance>(
          metres, within(0.001, 100), "Neighbours nearer than this count as overlap in the metrics (nothing else)."),
      param<&Params::voxel>(metres, within(0.001, 10), "Spacing of the points that are registered."),
      param<&Params::initial>(
          unitless, unbounded,
          "Start poses: x y z (m) and yaw (deg about z) for each scan after the first. Empty: all stand alike.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
