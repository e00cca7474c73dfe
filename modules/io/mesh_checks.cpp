#include <fmt/format.h>

#include <Eigen/Geometry>

#include "graph/api/error.hpp"
#include "modules/io/mesh_writers.hpp"

namespace atrium::io {

void check_mesh(const Mesh& mesh) {
  if (!mesh.origin.allFinite()) throw Error("the mesh's origin is not finite");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite()) throw Error(fmt::format("vertex {} of the mesh is not finite", i));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const auto corner : mesh.triangles[t])
      if (corner >= mesh.vertices.size())
        throw Error(
            fmt::format("triangle {} of the mesh has a corner at vertex {} of {}", t, corner, mesh.vertices.size()));
  const auto check = [](std::string_view column, std::size_t size, std::size_t wanted) {
    if (size != 0 && size != wanted)
      throw Error(fmt::format("the mesh's column '{}' has {} entries instead of {}", column, size, wanted));
  };
  check("colours", mesh.colours.size(), mesh.vertices.size());
  check("classes", mesh.classes.size(), mesh.triangles.size());
  check("storeys", mesh.storeys.size(), mesh.triangles.size());
  check("primitives", mesh.primitives.size(), mesh.triangles.size());
}

Eigen::Vector3d normal_of(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d cross = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  const double length = cross.norm();
  return length > 0 ? Eigen::Vector3d(cross / length) : Eigen::Vector3d::Zero();
}

}  // namespace atrium::io
