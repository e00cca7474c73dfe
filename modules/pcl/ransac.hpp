#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::pcl_nodes {

/// Finds the planes of a cloud one after another: the loop around pcl::SACSegmentation that PCL's tutorials show. Swaps
/// with plane.ransac and plane.region_growing. The plane with the most inliers is taken, its inliers leave the cloud,
/// and so on, until `max_planes` are found or the next one has fewer than `min_points`.
///
/// A plane here has no end: what lies in it beyond a gap, or on the other face of a wall within `distance`, belongs to
/// it, too (plane.ransac parts both). With normals and `normal_weight` above 0, SACMODEL_NORMAL_PLANE is searched, else
/// SACMODEL_PLANE. Planes are fitted to their inliers by least squares; their normals point to the mean of the cloud's
/// normals; without any, up (of an upright plane to +y, else +x).
///
/// One thread; each plane costs up to `max_iterations` passes over the points that are left. PCL always starts its
/// generator with the same number; the run's seed shuffles the points that it draws from. Error: fewer than 3 points.
struct Ransac {
  static constexpr std::string_view type = "pcl.ransac";
  static constexpr std::string_view summary = "Finds planes one after another (pcl::SACSegmentation).";
  static constexpr bool random = true;
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    int max_planes = 0;
    double distance = 0.02;
    int min_points = 0;
    double probability = 0.01;
    int max_iterations = 1000;
    double normal_weight = 0;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points, with normals if normal_weight is not 0.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::planes>("Primitives over the same cloud, by falling number of inliers.")};
  static constexpr auto params = std::tuple{
      param<&Params::max_planes>(count, within(0, 1e6), "Stop after this many planes; 0: no limit."),
      param<&Params::distance>(metres, within(1e-6, 10),
                               "Largest distance of an inlier from its plane (PCL's distance threshold)."),
      param<&Params::min_points>(count, within(0, 1e9), "Smallest plane. 0: one in 2000 of the points, at least 50."),
      param<&Params::probability>(
          ratio, within(1e-6, 0.5),
          "Probability with which no sample of inliers alone was drawn when a plane is taken: 1 less PCL's."),
      param<&Params::max_iterations>(count, within(1, 1e6), "Most samples drawn for a plane."),
      param<&Params::normal_weight>(
          ratio, within(0, 1),
          "Share of the angle between normals in an inlier's distance (PCL's normal distance weight); 0: none.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
