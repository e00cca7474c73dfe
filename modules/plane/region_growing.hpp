#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Finds the planes of a cloud by region growing on voxels: an alternative to plane.ransac that needs no normals.
///
/// 1. Second moments of the points of each voxel; voxels whose points lie in a plane are seeds, the flattest first.
/// 2. A region takes neighbouring voxels whose points lie near its plane, and is refitted from the summed moments.
///    Neighbouring regions that are one plane are merged.
/// 3. A region's connected components (as in plane.ransac) are patches; each point goes to the nearest patch.
/// 4. The same again (`passes`) with the points that are left, for small surfaces in voxels that larger ones had
///    spoilt. Voxels of sparse scans, wider than the least, are moved by a half, a quarter and
///    three quarters of their edge in turn (five passes at least): then the two faces of a wall as thin as a quarter
///    of it stand in different ones.
/// 5. Least-squares fit of each patch to its points.
///
/// Normals point to the side from which the surface was seen, told over the whole scene once all planes are known: by
/// the scanner's positions, else by free space, else by the cloud's normals (modules/plane/seen_side.hpp). No random
/// numbers: the seed changes nothing.
///
/// Errors: fewer than 3 points. A cloud without planes gives no primitives. Source: voxel-based growing after A.-V. Vo
/// et al., Octree-based region growing for point cloud segmentation, ISPRS J. 104, 2015.
struct RegionGrowing {
  static constexpr std::string_view type = "plane.region_growing";
  static constexpr std::string_view summary = "Finds planes by growing regions of flat voxels; needs no normals.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    int max_planes = 0;
    double voxel_size = 0;
    double min_voxel_size = 0.05;
    double distance = 0.02;
    double min_distance = 0.002;
    double cluster_distance = 0;
    double angle = 25;
    double min_area = 0.2;
    int min_points = 0;
    std::int64_t passes = 2;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points; normals only turn the planes.")};
  static constexpr auto outputs = std::tuple{
      port<&Out::planes>("Primitives over the same cloud, by falling number of inliers; normals to the side seen.")};
  static constexpr auto params = std::tuple{
      param<&Params::max_planes>(count, within(0, 1e6),
                                 "Keep this many planes, the largest (the paper's number of primitives); 0: all."),
      param<&Params::voxel_size>(
          metres, within(0, 10),
          "Edge of the voxels: less than the thinnest wall. 0: min_voxel_size, doubled until half of the points share "
          "their voxel with four others, and until it is four times the noise where `distance` is 0."),
      param<&Params::min_voxel_size>(metres, within(0.001, 10),
                                     "Edge of the voxels of dense scans, where voxel_size is 0."),
      param<&Params::distance>(
          metres, within(0, 10),
          "Largest distance of a point from its plane. 0: 2.5 times the noise, but no less than min_distance. The "
          "noise is the median residual around flat voxels; where these are coarse the lower quartile, or twice the "
          "voxels' own median residual where the quartile is more than four times that."),
      param<&Params::min_distance>(
          metres, within(0, 10),
          "Least distance where `distance` is 0: what drift and unevenness take even where the noise is small."),
      param<&Params::cluster_distance>(
          metres, within(0, 10),
          "Points of a plane nearer to each other than this are connected, wider gaps make two planes. 0: 3 cm, or "
          "what "
          "the cloud's spacing around the plane wants where that is more."),
      param<&Params::angle>(degrees, within(1, 89),
                            "Largest angle between a flat voxel's plane and that of the region which takes it."),
      param<&Params::min_area>(
          square_metres, within(0, 1000),
          "Smallest plane, counted in squares as wide as its points' spacing: the size of the scene and the scanner's "
          "distance do not matter."),
      param<&Params::min_points>(
          count, within(0, 1e9),
          "Fewest points of a plane. 0: half as many as min_area holds where the scan is sparse, at least 50."),
      param<&Params::passes>(
          count, within(1, 100),
          "How often the points that are left are searched again: both faces of a thin wall stand in the same voxels, "
          "and the second shows once the first is found. Ends when nothing is found.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
