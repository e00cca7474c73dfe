#include "modules/metric/mesh_samples.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "graph/api/error.hpp"

namespace atrium::metric {

MeshSamples sample_mesh(const Mesh& mesh, double spacing, double max_samples, const std::vector<bool>& wanted) {
  MeshSamples samples;
  std::vector<double> areas(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (!wanted.empty() && !wanted[i]) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    areas[i] = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm() / 2;
    samples.area += areas[i];
  }
  samples.spacing = std::max(spacing, std::sqrt(samples.area / max_samples));
  // The plastic number's powers: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
  constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (!(areas[i] > 0)) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d corner = mesh.vertices[a], ab = mesh.vertices[b] - corner, ac = mesh.vertices[c] - corner;
    const auto count =
        static_cast<std::size_t>(std::max(1.0, std::round(areas[i] / (samples.spacing * samples.spacing))));
    // One point stands at the centroid, many fill the triangle: both coordinates start a half step in.
    double u = count == 1 ? 1.0 / 3 : 0.5, v = count == 1 ? 1.0 / 3 : 0.5;
    for (std::size_t k = 0; k < count; ++k) {
      const bool folded = u + v > 1;
      samples.points.emplace_back(corner + (folded ? 1 - u : u) * ab + (folded ? 1 - v : v) * ac);
      samples.weights.push_back(areas[i] / static_cast<double>(count));
      samples.triangles.push_back(static_cast<std::uint32_t>(i));
      u = std::fmod(u + step_u, 1.0);
      v = std::fmod(v + step_v, 1.0);
    }
  }
  return samples;
}

void check_mesh(const Mesh& mesh, const std::string& what) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite())
      throw Error(what + ": vertex " + std::to_string(i) + " is not finite", "remove or repair it");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const auto v : mesh.triangles[i])
      if (v >= mesh.vertices.size())
        throw Error(what + ": triangle " + std::to_string(i) + " names vertex " + std::to_string(v) + " of " +
                    std::to_string(mesh.vertices.size()));
  const std::array<std::pair<const char*, std::size_t>, 3> columns{
      {{"classes", mesh.classes.size()}, {"storeys", mesh.storeys.size()}, {"primitives", mesh.primitives.size()}}};
  for (const auto& [name, size] : columns)
    if (size != 0 && size != mesh.triangles.size())
      throw Error(what + " has " + std::to_string(size) + " " + name + " for " + std::to_string(mesh.triangles.size()) +
                      " triangles",
                  "a column is empty or as long as what it describes");
}

std::vector<Eigen::Vector3d> vertices_about(const Mesh& mesh, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d shift = mesh.origin - origin;
  std::vector<Eigen::Vector3d> vertices = mesh.vertices;
  for (auto& v : vertices) v += shift;
  return vertices;
}

}  // namespace atrium::metric
