#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/plane/cell_set.hpp"
#include "modules/plane/point_octree.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// A plane and where in it the surface is.
struct Patch {
  Plane plane;    ///< in the columns' frame, turned to the side from which it was seen
  CellSet cells;  ///< its connected component, and the cells that touch it
};

/// For each point, in Morton order, the nearest of the patches that it supports and lies over (-1: none), and how far
/// that is. Of patches at the same distance the first wins.
struct Assignment {
  std::vector<std::int32_t> owner;
  std::vector<float> distance;  ///< metres

  explicit Assignment(std::size_t points)
      : owner(points, -1), distance(points, std::numeric_limits<float>::infinity()) {}
  /// Takes in the patches from number `first` on; those before are known already.
  void add(const MortonOrder& order, const PointOctree& octree, const std::vector<Patch>& patches, std::size_t first,
           const Tolerance& tolerance, const Context& context);
};

/// The points of one plane as a primitive: the plane by least squares, turned to the mean of their normals (to `side`
/// where the cloud has none). At least one point.
PlanePrimitive fit_primitive(const Cloud& cloud, std::vector<std::uint32_t> inliers, const Eigen::Vector3d& side);

/// The patches that own at least `min_points` points as primitives over the cloud: planes refitted to what they own and
/// turned to the mean of their points' normals (to the patch's own normal where the cloud has none).
PlanePrimitives fit_primitives(const std::shared_ptr<const Cloud>& cloud, const MortonOrder& order,
                               const std::vector<std::int32_t>& owner, const std::vector<Patch>& patches,
                               std::size_t min_points, const Context& context);

}  // namespace atrium::plane
