#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::pcl_nodes {

/// Finds the planes of a cloud by growing regions from point to point (pcl::RegionGrowing, as PCL's tutorials use it,
/// with its smoothness test against the region's first normal). Swaps with plane.region_growing and plane.ransac.
///
/// A region takes a neighbour whose normal is within `angle` of its first point's, and grows on from it if it is within
/// `distance` of the plane through the point before. Each region is fitted by least squares; a region is not tested for
/// being flat, so its residual says how good it is. Normals of planes point to the mean of the points' normals. No
/// random numbers, one thread.
///
/// Errors: no normals; fewer than 3 points. A cloud without regions gives no primitives.
struct RegionGrowing {
  static constexpr std::string_view type = "pcl.region_growing";
  static constexpr std::string_view summary = "Finds planes by growing regions of like normals (pcl::RegionGrowing).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    int max_planes = 0;
    double distance = 0.02;
    double angle = 10;
    int min_points = 0;
    std::int64_t neighbours = 16;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with normals.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::planes>("Primitives over the same cloud, by falling number of inliers.")};
  static constexpr auto params = std::tuple{
      param<&Params::max_planes>(count, within(0, 1e6), "Keep this many planes, the largest; 0: all."),
      param<&Params::distance>(
          metres, within(1e-6, 10),
          "A point further from the plane through the one before is the region's rim (PCL's residual threshold)."),
      param<&Params::angle>(degrees, within(0.1, 89),
                            "Largest angle between a normal and the region's first (PCL's smoothness threshold)."),
      param<&Params::min_points>(count, within(0, 1e9), "Smallest region. 0: one in 2000 of the points, at least 50."),
      param<&Params::neighbours>(count, within(3, 1000), "Nearest points that a region may go on to.")};
  static Out run(const In& in, const Params& params);
};

}  // namespace atrium::pcl_nodes
