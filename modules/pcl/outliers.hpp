#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::pcl_nodes {

enum class OutlierMethod { statistical, radius };

/// Removes points that stand alone, by PCL's filters: swaps with filter.outliers.
///
/// - statistical: pcl::StatisticalOutlierRemoval. A point goes if its mean distance to its `neighbours` nearest points
///   lies more than `deviations` standard deviations above the mean of that distance. filter.outliers differs where a
///   few points far away spoil mean and deviation: it takes them again without those.
/// - radius: pcl::RadiusOutlierRemoval. A point goes if fewer than `min_neighbours` others stand within `radius`.
///
/// Points keep their order and columns. One thread. A cloud of no more points than `neighbours` is handed on whole
/// (statistical), with a warning if it is not empty.
struct Outliers {
  static constexpr std::string_view type = "pcl.outliers";
  static constexpr std::string_view summary = "Removes points that stand alone (PCL's statistical or radius filter).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
    std::int64_t removed = 0;
  };
  struct Params {
    OutlierMethod method = OutlierMethod::statistical;
    std::int64_t neighbours = 16;
    double deviations = 3;
    double radius = 0.1;
    std::int64_t min_neighbours = 5;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The points that are no outliers."),
                                             port<&Out::removed>("How many points were removed.")};
  static constexpr auto params = std::tuple{
      param<&Params::method>({{"statistical", OutlierMethod::statistical}, {"radius", OutlierMethod::radius}},
                             "Which of PCL's filters."),
      param<&Params::neighbours>(count, within(1, 1000), "Nearest points (statistical; PCL's mean k)."),
      param<&Params::deviations>(
          unitless, within(0.1, 100),
          "Standard deviations above the mean that are still normal (statistical; PCL's std mul)."),
      param<&Params::radius>(metres, within(1e-4, 100), "Search radius (radius)."),
      param<&Params::min_neighbours>(count, within(1, 10000), "Least number of others within it (radius).")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
