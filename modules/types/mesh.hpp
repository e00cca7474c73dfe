#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/cloud.hpp"
#include "modules/types/plane_primitives.hpp"
#include "modules/types/structure.hpp"

namespace atrium {

/// A triangle mesh. Metres; a vertex's place in the mesh's frame is origin + vertex. Columns are empty or as long as
/// what they describe.
struct Mesh {
  static constexpr std::string_view port_type = "Mesh";
  static constexpr auto members() {
    return std::tuple{&Mesh::origin,  &Mesh::vertices, &Mesh::colours,   &Mesh::triangles,
                      &Mesh::classes, &Mesh::storeys,  &Mesh::primitives};
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Colour> colours;                          ///< per vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the room
  std::vector<SurfaceClass> classes;                    ///< per triangle
  std::vector<std::int32_t> storeys;                    ///< per triangle; -1: none
  std::vector<std::int32_t> primitives;                 ///< per triangle; source primitive, -1: none
};

Mesh transformed(const Mesh& mesh, const Transform& transform);

}  // namespace atrium
