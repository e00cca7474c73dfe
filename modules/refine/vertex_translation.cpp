#include "modules/refine/vertex_translation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>

#include "modules/geometry/linear_solve.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/refine/check.hpp"

namespace atrium::refine {
namespace {

struct Line {
  Eigen::Vector3d point, direction;
  Eigen::Vector3d nearest(const Eigen::Vector3d& x) const { return point + direction * direction.dot(x - point); }
};

/// Where two planes meet; nothing if they are parallel. Equations 4 to 6 with the plane through the origin across the
/// line in place of Z = 0.
std::optional<Line> intersection(const Plane& a, const Plane& b, double parallel_tolerance) {
  const Eigen::Vector3d direction = a.normal.cross(b.normal);
  const double length = direction.norm();
  if (length < parallel_tolerance || length == 0) return std::nullopt;
  Eigen::Matrix3d system;
  system << direction.transpose() / length, a.normal.transpose(), b.normal.transpose();
  return Line{linear_solve(system, {0, -a.offset, -b.offset}), direction / length};
}

bool is_sound(const PlaneMesh& mesh) {
  constexpr double tolerance = 1e-9;   // metres
  constexpr double least_area = 1e-4;  // square metres
  const PlaneFrame frame = upright_frame(mesh.plane, mesh.corners.front());
  Polygon2 polygon;
  for (const auto& corner : mesh.corners) polygon.push_back(frame.to_plane(corner));
  return area(polygon) > least_area && is_convex(polygon, tolerance);
}

/// Moves the given corners onto the line if the mesh stays sound.
void move(PlaneMesh& mesh, std::initializer_list<std::size_t> which, const Line& line) {
  PlaneMesh moved = mesh;
  for (const std::size_t i : which) moved.corners[i] = line.nearest(mesh.corners[i]);
  if (is_sound(moved)) mesh = std::move(moved);
}

/// Moves the mesh's vertices that are nearest to the line onto it, where that is legal.
void translate(PlaneMesh& mesh, const Line& line, const VertexTranslation::Params& params) {
  const auto& corners = mesh.corners;
  const std::size_t n = corners.size();
  std::vector<double> distances;
  distances.reserve(n);
  for (const auto& corner : corners) distances.push_back((line.nearest(corner) - corner).norm());
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t l, std::size_t r) { return distances[l] < distances[r]; });
  const std::size_t first = order[0];
  const std::size_t second = order[1];
  const bool reaches_second = distances[second] <= params.max_separation;
  if (params.moves == Moves::edge) {
    const bool is_edge = (first + 1) % n == second || (second + 1) % n == first;
    if (reaches_second && is_edge) move(mesh, {first, second}, line);
    return;
  }
  if (distances[first] <= params.max_separation) move(mesh, {first}, line);
  if (params.moves == Moves::vertices && reaches_second) move(mesh, {second}, line);
}

}  // namespace

VertexTranslation::Out VertexTranslation::run(const In& in, const Params& params) {
  check_matches(*in.adjacency, *in.meshes);
  const auto& meshes = in.meshes->meshes;
  Out out{*in.meshes, 0};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].surface != SurfaceClass::wall) continue;
    PlaneMesh& wall = out.meshes.meshes[i];
    for (const std::size_t j : in.adjacency->neighbours(i)) {
      if (meshes[j].surface != SurfaceClass::wall) continue;
      if (const auto line = intersection(meshes[i].plane, meshes[j].plane, params.parallel_tolerance))
        translate(wall, *line, params);
    }
    for (std::size_t k = 0; k < wall.corners.size(); ++k)
      if ((wall.corners[k] - meshes[i].corners[k]).norm() > 1e-9) ++out.moved;
  }
  return out;
}

}  // namespace atrium::refine
