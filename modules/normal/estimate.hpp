#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::normal {

enum class Method { voxels, radius, neighbours };

/// Gives each point the normal of the surface that it lies on. Normals are unit and finite. Their sign: the side of the
/// normals that the cloud had before; without any, the largest component is positive (see normal.orient).
///
/// - voxels: a plane per voxel of edge `voxel` from the second moments of its points and those of its 26 neighbours.
/// Where
///   these do not lie in one plane (near an edge), the plane of whichever neighbour fits the voxel best is taken (the
///   idea of Kuwahara's filter, 1976) and refitted over the voxels that lie in it; the points of a voxel that an edge
///   runs through go each to the nearest of the planes around. What counts as lying in a plane follows from the noise,
///   which is measured over all voxels. By far the fastest, and exact up to edges.
/// - radius: principal axes of all points within `radius` of each point (where more than 8192 stand in the 27 cells
/// around,
///   evenly chosen ones). Rounds edges off by the radius.
/// - neighbours: principal axes of the `neighbours` nearest points. A fixed count shrinks with growing density until
/// only
///   noise is seen: for comparison, and for clouds of very uneven density.
///
/// Points with fewer than 5 points around, or with all of them on a line, are given the normal of their 16 nearest
/// points, however far; a cloud of fewer than three points gets +z, with a warning. An empty cloud gives an empty
/// cloud.
struct Estimate {
  static constexpr std::string_view type = "normal.estimate";
  static constexpr std::string_view summary = "Estimates the normal of the surface at each point.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    Method method = Method::voxels;
    double voxel = 0.05;
    double radius = 0.05;
    std::int64_t neighbours = 16;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The same points and columns, with normals.")};
  static constexpr auto params = std::tuple{
      param<&Params::method>(
          {{"voxels", Method::voxels}, {"radius", Method::radius}, {"neighbours", Method::neighbours}},
          "How the points that share a plane are found."),
      param<&Params::voxel>(
          metres, within(0.001, 10),
          "Edge of a voxel (method voxels). Above 5 cm, the two sides of a 12 cm wall fall into one neighbourhood."),
      param<&Params::radius>(metres, within(0.001, 10), "Search radius (method radius)."),
      param<&Params::neighbours>(count, within(3, 1000), "Points in a neighbourhood (method neighbours).")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::normal
