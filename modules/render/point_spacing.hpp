#pragma once
#include <Eigen/Core>
#include <vector>

namespace atrium::render {

/// How dense a cloud is on its surfaces.
struct PointSpacing {
  double spacing = 0;      ///< metres between points on a surface, at the median over the surfaces; 0 for one point
  std::vector<char> lone;  ///< per point: nothing else is near (noise in the air, mostly)
};

/// From the number of points in cubes of the size of a few spacings.
PointSpacing point_spacing(const std::vector<Eigen::Vector3f>& points);

}  // namespace atrium::render
