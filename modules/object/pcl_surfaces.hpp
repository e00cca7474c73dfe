#pragma once
#include "modules/object/surface.hpp"

namespace atrium::object {

/// Settings of pcl::Poisson; what is not here has PCL's defaults (B-splines of degree 2).
struct PoissonSettings {
  int depth = 8;
  double samples_per_node = 1.5;
  double point_weight = 4;
  double scale = 1.1;       ///< of the cube that is solved in, over the cloud's box
  bool confidence = false;  ///< whether the lengths of normals count
};

/// The closed surface of pcl::Poisson. It runs on one thread (its parallel sums come in the order in which threads
/// arrive), and reconstructions of one program wait for each other (its octree takes nodes from one pool). PCL prints
/// remarks about open edges to stdout, which a run sets aside. The cloud has points with normals, in more places than
/// one (is_surface).
RawSurface poisson_surface(const Cloud& cloud, const PoissonSettings& settings);

/// Settings of pcl::GreedyProjectionTriangulation, angles in degrees.
struct GreedySettings {
  double search_radius = 0.1;
  double reach = 2.5;  ///< PCL's mu
  std::int64_t max_neighbours = 100;
  double max_surface_angle = 45;
  double min_angle = 10;
  double max_angle = 120;
  bool normal_consistency = true;
};

/// Triangles over the points themselves: vertex i is point i. The cloud has normals.
RawSurface greedy_surface(const Cloud& cloud, const GreedySettings& settings);

}  // namespace atrium::object
