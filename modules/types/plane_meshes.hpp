#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/structure.hpp"

namespace atrium {

/// One convex planar polygon of the structure: the paper's M_{P_i}, or a piece of it after clipping.
struct PlaneMesh {
  static constexpr auto members() {
    return std::tuple{&PlaneMesh::primitive, &PlaneMesh::surface, &PlaneMesh::storey, &PlaneMesh::plane,
                      &PlaneMesh::corners};
  }
  std::int32_t primitive = -1;  ///< index into the primitives that it came from
  SurfaceClass surface = SurfaceClass::wall;
  std::int32_t storey = 0;
  Plane plane;
  std::vector<Eigen::Vector3d> corners;  ///< counter-clockwise seen from the side that plane.normal points to
};

/// The planar meshes of the structure. Coordinates are relative to origin, z up after alignment, metres.
struct PlaneMeshes {
  static constexpr std::string_view port_type = "PlaneMeshes";
  static constexpr auto members() { return std::tuple{&PlaneMeshes::origin, &PlaneMeshes::meshes}; }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<PlaneMesh> meshes;
};

}  // namespace atrium
