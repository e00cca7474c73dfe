#pragma once
#include <string>

#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Adds the rectangle corner, corner + a, corner + a + b, corner + b; its normal is a × b.
inline void add_rectangle(Mesh& mesh, const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          SurfaceClass surface, int primitive) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {corner, corner + a, corner + a + b, corner + b});
  for (const std::array<std::uint32_t, 3>& t :
       {std::array{first, first + 1, first + 2}, {first, first + 2, first + 3}}) {
    mesh.triangles.push_back(t);
    mesh.classes.push_back(surface);
    mesh.storeys.push_back(0);
    mesh.primitives.push_back(primitive);
  }
}

/// A room of 4 m × 5 m × 2.5 m seen from inside: floor (0), ceiling (1), walls y=0 (2), x=4 (3), y=5 (4), x=0 (5).
inline Mesh room() {
  using V = Eigen::Vector3d;
  Mesh m;
  add_rectangle(m, V(0, 0, 0), V(4, 0, 0), V(0, 5, 0), SurfaceClass::floor, 0);
  add_rectangle(m, V(0, 0, 2.5), V(0, 5, 0), V(4, 0, 0), SurfaceClass::ceiling, 1);
  add_rectangle(m, V(0, 0, 0), V(0, 0, 2.5), V(4, 0, 0), SurfaceClass::wall, 2);
  add_rectangle(m, V(4, 0, 0), V(0, 0, 2.5), V(0, 5, 0), SurfaceClass::wall, 3);
  add_rectangle(m, V(4, 5, 0), V(0, 0, 2.5), V(-4, 0, 0), SurfaceClass::wall, 4);
  add_rectangle(m, V(0, 5, 0), V(0, 0, 2.5), V(0, -5, 0), SurfaceClass::wall, 5);
  return m;
}

/// The value of a metric; a number no test expects where there is none.
inline double value(const Metrics& metrics, const std::string& name) {
  for (const auto& m : metrics.values)
    if (m.name == name) return m.value;
  return -12345;
}
inline bool has(const Metrics& metrics, const std::string& name) { return value(metrics, name) != -12345; }

}  // namespace atrium::metric
