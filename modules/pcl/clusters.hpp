#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::pcl_nodes {

/// Groups the points that stand nearer to each other than `tolerance` (pcl::EuclideanClusterExtraction) and keeps the
/// groups of at least `min_points`. Its ports are those of filter.outliers: where points of objects are cleaned, it
/// removes all that hangs together with few others only.
///
/// The label of a point is its cluster: 0 is the largest, of equals the one with the lowest point. Labels that the
/// cloud had are replaced. Points keep their order and their other columns. One thread, no random numbers. An empty
/// cloud gives an empty cloud.
struct Clusters {
  static constexpr std::string_view type = "pcl.clusters";
  static constexpr std::string_view summary = "Labels groups of near points (pcl::EuclideanClusterExtraction).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
    std::int64_t removed = 0;
    std::int64_t clusters = 0;
  };
  struct Params {
    double tolerance = 0.05;
    std::int64_t min_points = 50;
    std::int64_t max_points = 0;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The points of the clusters; labels are their numbers."),
                                             port<&Out::removed>("How many points are in no cluster."),
                                             port<&Out::clusters>("How many clusters there are.")};
  static constexpr auto params = std::tuple{
      param<&Params::tolerance>(metres, within(1e-4, 100), "Points nearer than this belong together."),
      param<&Params::min_points>(count, within(1, 1e9), "Smallest cluster."),
      param<&Params::max_points>(count, within(0, 1e9), "Largest cluster: larger ones are left out. 0: no limit.")};
  static Out run(const In& in, const Params& params);
};

}  // namespace atrium::pcl_nodes
