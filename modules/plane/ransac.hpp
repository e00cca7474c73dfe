#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Finds the planes of a cloud by efficient RANSAC (R. Schnabel, R. Wahl, R. Klein: Efficient RANSAC for Point-Cloud
/// Shape Detection, Computer Graphics Forum 26(2), 2007): the vertex groups P = {P_i} of the paper, section "Primitive
/// Extraction".
///
/// Candidates come from three points of one cell of an octree, on levels that adapt; they are scored on random subsets,
/// on more points only as long as they compete; the best is taken when the probability that a larger one was missed is
/// below `probability`. Of a candidate's support the largest component that is connected in the plane is kept, fitted
/// by least squares and taken out. At the end every point goes to the nearest of the planes that claim it, and all
/// planes are fitted again.
///
/// A point supports a plane if it is at most `distance` away and its normal within `normal_angle` of the plane's:
/// coplanar surfaces that face opposite ways are two primitives, so normals have to be oriented (normal.orient). Points
/// with the normal 0 belong to no plane. The result is the same with any number of threads; another seed may move
/// points between planes that compete for them and change which of the smallest planes are found.
///
/// Errors: no normals; fewer than 3 points. A cloud without planes gives no primitives.
struct Ransac {
  static constexpr std::string_view type = "plane.ransac";
  static constexpr std::string_view summary = "Finds planes by efficient RANSAC with localized sampling.";
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
    double cluster_distance = 0;
    double normal_angle = 45;
    int min_points = 0;
    double probability = 0.01;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with oriented normals.")};
  static constexpr auto outputs = std::tuple{
      port<&Out::planes>("Primitives over the same cloud, by falling number of inliers; normals to the side seen.")};
  static constexpr auto params = std::tuple{
      param<&Params::max_planes>(
          count, within(0, 1e6),
          "Stop after this many planes, the largest first (the paper's number of primitives); 0: no limit."),
      param<&Params::distance>(
          metres, within(1e-6, 10),
          "Largest distance of a point from its plane (Schnabel's epsilon): about 2.5 times the noise."),
      param<&Params::cluster_distance>(
          metres, within(0, 10),
          "Points of a plane nearer to each other than this are connected (Schnabel's beta), wider gaps make two "
          "planes. "
          "0: 3 cm, or what the cloud's spacing around the plane wants where that is more."),
      param<&Params::normal_angle>(
          degrees, within(1, 89),
          "Largest angle between a point's normal and its plane's (Schnabel's alpha); estimated normals want it wide."),
      param<&Params::min_points>(count, within(0, 1e9), "Smallest plane. 0: one in 2000 of the points, at least 50."),
      param<&Params::probability>(
          ratio, within(1e-6, 0.5),
          "Probability with which a larger plane may be missed when one is taken, or the search ends.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
