#pragma once
#include <array>
#include <vector>

#include "modules/types/floor_plan.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::floorplan {

/// One planar face of the structure in the frame of the plan: the triangles of one primitive, class and storey.
struct Surface {
  SurfaceClass surface = SurfaceClass::wall;
  std::int32_t storey = 0;
  std::int32_t primitive = -1;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit length, to the side from which it is seen
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of its area
  double area = 0;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
};

/// The direction that points up in the mesh's frame: that of its floors, else of its ceilings, weighted by area; else
/// z.
Eigen::Vector3d up_of(const Mesh& mesh);

/// The walls, floors and ceilings of the mesh, place p of it at rotation · (p − origin). In the order of storey, class
/// and primitive. Triangles of no primitive count as one surface where they share an edge and lie in one plane (within
/// 1°). Triangles without area go into `dropped`.
std::vector<Surface> surfaces_of(const Mesh& mesh, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin,
                                 std::size_t& dropped);

}  // namespace atrium::floorplan
