#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/point_grid.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::normal {

/// The points of a voxel that lie in about the same plane.
struct Surfel {
  Eigen::Vector3f axis;    ///< unit; its sign is that of most of its points' normals
  Eigen::Vector3f centre;  ///< mean of its points
  std::uint32_t cell;
};

/// A cloud as surfels over a grid, and their smooth regions.
struct Surfels {
  Surfels(const Cloud& cloud, const PointGrid& grid, const Context& context);

  std::vector<Surfel> surfels;          ///< by cell
  std::vector<std::uint32_t> first;     ///< per cell its first surfel, and one more entry behind
  std::vector<std::uint32_t> of_point;  ///< per position in the grid's order
  /// Surfels that touch, lie in nearly one plane and have nearly one axis; signs make the axes of a region agree.
  std::vector<std::vector<std::uint32_t>> regions;
  std::vector<float> signs;  ///< per surfel, 1 or -1

 private:
  void gather(const Cloud& cloud, const PointGrid& grid, const Context& context);
  void grow(const PointGrid& grid, const Context& context);
};

}  // namespace atrium::normal
