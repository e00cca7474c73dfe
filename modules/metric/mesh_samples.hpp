#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/types/mesh.hpp"

namespace atrium::metric {

/// Points spread evenly over triangles: about one per spacing², at least one per triangle, along Roberts' R2 sequence
/// (no randomness). Each stands for `weight` square metres of its triangle.
struct MeshSamples {
  std::vector<Eigen::Vector3d> points;  ///< in the mesh's local coordinates
  std::vector<double> weights;          ///< m²; sums to the triangles' area
  std::vector<std::uint32_t> triangles;
  double area = 0;
  double spacing = 0;  ///< the asked one, or more where that would have needed more than max_samples
};

/// Samples the triangles for which `wanted` is true (all if it is empty). Triangles without area give nothing.
MeshSamples sample_mesh(const Mesh& mesh, double spacing, double max_samples, const std::vector<bool>& wanted = {});

/// Throws Error if an index points past the vertices, a coordinate is not finite, or a column is neither empty nor as
/// long as the triangles. `what` names the mesh.
void check_mesh(const Mesh& mesh, const std::string& what);

/// The mesh's vertices in local coordinates about another origin.
std::vector<Eigen::Vector3d> vertices_about(const Mesh& mesh, const Eigen::Vector3d& origin);

}  // namespace atrium::metric
