#pragma once
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/triangle_tree.hpp"
#include "modules/metric/validity.hpp"
#include "modules/types/mesh.hpp"
#include "tests/unit/baseline/closed_surface.hpp"

namespace atrium::baseline {

using Eigen::Vector3d;

/// Adds corner + a·i/n + b·j/n as a grid of 2·n² triangles whose normal is a × b.
inline void add_grid(Mesh& mesh, const Vector3d& corner, const Vector3d& a, const Vector3d& b, int n) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.vertices.emplace_back(corner + a * i / n + b * j / n);
  for (std::uint32_t j = 0; j + 1 < row; ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t k = first + j * row + i;
      mesh.triangles.push_back({k, k + 1, k + row + 1});
      mesh.triangles.push_back({k, k + row + 1, k + row});
    }
}

/// Makes vertices within a micrometre of each other one.
inline Mesh welded(const Mesh& mesh) {
  Mesh result;
  result.origin = mesh.origin;
  std::map<std::array<long, 3>, std::uint32_t> index;
  std::vector<std::uint32_t> of;
  for (const auto& v : mesh.vertices) {
    const std::array<long, 3> key{std::lround(v.x() * 1e6), std::lround(v.y() * 1e6), std::lround(v.z() * 1e6)};
    const auto [place, added] = index.try_emplace(key, static_cast<std::uint32_t>(result.vertices.size()));
    if (added) result.vertices.push_back(v);
    of.push_back(place->second);
  }
  for (const auto& t : mesh.triangles) result.triangles.push_back({of[t[0]], of[t[1]], of[t[2]]});
  return result;
}

/// A closed box from (0, 0, 0) to `size`, seen from outside, n × n squares per side.
inline Mesh box(const Vector3d& size, int n) {
  Mesh m;
  const Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  add_grid(m, Vector3d::Zero(), y, x, n);
  add_grid(m, z, x, y, n);
  add_grid(m, Vector3d::Zero(), x, z, n);
  add_grid(m, y, z, x, n);
  add_grid(m, Vector3d::Zero(), z, y, n);
  add_grid(m, x, y, z, n);
  return welded(m);
}

/// A closed sphere about `centre`: a cube's grid blown up.
inline Mesh sphere(const Vector3d& centre, double radius, int n) {
  Mesh m = box(Vector3d(2, 2, 2), n);
  for (auto& v : m.vertices) v = centre + radius * (v - Vector3d(1, 1, 1)).normalized();
  return m;
}

inline double area(const Mesh& mesh) {
  double twice = 0;
  for (const auto& t : mesh.triangles)
    twice += (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm();
  return twice / 2;
}

/// The greatest distance of a vertex of `from` to the surface `to`.
inline double greatest_distance(const Mesh& from, const Mesh& to) {
  const TriangleTree tree(to.vertices, to.triangles);
  double most = 0;
  for (const auto& v : from.vertices) most = std::max(most, std::sqrt(tree.nearest(v).squared_distance));
  return most;
}

/// A number of metric.validity.
inline double validity(const Mesh& mesh, const std::string& name) {
  Context context;
  const auto metrics = metric::Validity::run({input(mesh)}, {}, context).metrics;
  for (const auto& m : metrics.values)
    if (m.name == "validity." + name) return m.value;
  return -12345;
}

inline bool same_with_any_threads(const std::function<std::string()>& hash) {
  std::set<std::string> seen;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    seen.insert(hash());
  }
  return seen.size() == 1;
}

/// The message of the error that `run` throws; "" if it throws none.
inline std::string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace atrium::baseline
