#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::filter {

/// Statistical outlier removal (Rusu et al., "Towards 3D point cloud based object maps for household environments",
/// 2008): the paper's noise reduction and the 'statistical treatment' of its non-structural points. A point is an
/// outlier if its mean distance to its `neighbours` nearest points lies more than `deviations` standard deviations
/// above the mean of that distance over the cloud. A few points far beyond all others would spoil mean and deviation
/// for the rest: where leaving the outliers out more than halves that limit, both are taken again without them. Of
/// clouds of more than 520 000 points mean and deviation are those of 130 000 or more, spread evenly over the scene.
///
/// Points keep their order and columns. A cloud of no more points than `neighbours` is handed on whole, with a warning
/// if it is not empty. Evenly spaced or coincident points have no outliers.
struct Outliers {
  static constexpr std::string_view type = "filter.outliers";
  static constexpr std::string_view summary = "Removes points that stand far from their neighbours.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
    std::int64_t removed = 0;
  };
  struct Params {
    std::int64_t neighbours = 16;
    double deviations = 3;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The points that are no outliers."),
                                             port<&Out::removed>("How many points were removed.")};
  static constexpr auto params = std::tuple{
      param<&Params::neighbours>(count, within(1, 1000), "Nearest points whose mean distance is taken."),
      param<&Params::deviations>(
          unitless, within(0.1, 100),
          "Standard deviations above the mean that are still normal. A LiDAR's density falls with distance: below 2, "
          "far walls begin to go.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::filter
