#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::pcl_nodes {

enum class Neighbourhood { radius, neighbours };

/// Gives each point the normal of the surface that it lies on, by pcl::NormalEstimation (principal axes of the points
/// around): swaps with normal.estimate, whose methods `radius` and `neighbours` are the same thing. Its method `voxels`
/// is not in PCL.
///
/// Normals are unit and finite. Their sign: the side of the normals that the cloud had before; without any, the largest
/// component is positive (PCL's viewpoint is not used: normal.orient does that). Points for which PCL finds fewer than
/// three neighbours keep the normal that they had, or get +z, with a warning. Points are shared out over the run's
/// threads; each normal is computed by itself, so their number does not matter. An empty cloud gives an empty cloud.
struct Normals {
  static constexpr std::string_view type = "pcl.normals";
  static constexpr std::string_view summary = "Estimates normals from the points around (pcl::NormalEstimation).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    Neighbourhood method = Neighbourhood::radius;
    double radius = 0.05;
    std::int64_t neighbours = 16;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The same points and columns, with normals.")};
  static constexpr auto params =
      std::tuple{param<&Params::method>({{"radius", Neighbourhood::radius}, {"neighbours", Neighbourhood::neighbours}},
                                        "Which points are around a point."),
                 param<&Params::radius>(metres, within(0.001, 10), "Search radius (method radius)."),
                 param<&Params::neighbours>(count, within(3, 1000), "Nearest points (method neighbours; PCL's k).")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
