#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::pcl_nodes {

/// The convex hull of a cloud as a closed mesh (pcl::ConvexHull, which is Qhull): swaps with object.poisson. With
/// `by_label` each label has a hull of its own: behind pcl.clusters, one box-like body per piece of furniture.
///
/// Triangles are counter-clockwise seen from outside; vertices are points of the cloud, with their colours. Fewer than
/// 10 points of a label, or points in one plane, have no body: they are left out, and a line in the log counts them.
/// One thread, no random numbers. An empty cloud gives an empty mesh.
struct ConvexHull {
  static constexpr std::string_view type = "pcl.convex_hull";
  static constexpr std::string_view summary = "Convex hull of a cloud, or of each of its labels (pcl::ConvexHull).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
  };
  struct Params {
    bool by_label = false;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points of the objects.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Their hull, in the cloud's frame.")};
  static constexpr auto params = std::tuple{param<&Params::by_label>(
      "One hull for each label instead of one for all points. Error: a cloud without labels.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
