#pragma once
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "meshes.hpp"
#include "modules/metric/validity.hpp"

namespace atrium::metric {

/// Twelve triangles that look outwards, eight shared vertices.
inline void add_box(Mesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                               (i & 4) != 0 ? high.z() : low.z());
  for (const auto& [a, b, c, d] : {std::array{0U, 2U, 3U, 1U},
                                   {4U, 5U, 7U, 6U},
                                   {0U, 1U, 5U, 4U},
                                   {1U, 3U, 7U, 5U},
                                   {3U, 2U, 6U, 7U},
                                   {2U, 0U, 4U, 6U}}) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
  }
}
inline Mesh box(const Eigen::Vector3d& low = Eigen::Vector3d::Zero(),
                const Eigen::Vector3d& high = Eigen::Vector3d::Ones()) {
  Mesh mesh;
  add_box(mesh, low, high);
  return mesh;
}
inline Metrics validity(const Mesh& mesh, const Validity::Params& params = {}) {
  Context context;
  return Validity::run({input(mesh)}, params, context).metrics;
}
inline void expect_clean(const Metrics& m) {
  for (const char* name :
       {"degenerate_faces", "duplicate_faces", "edges.boundary", "edges.non_manifold", "edges.misoriented",
        "vertices.non_manifold", "self_intersections.crossing", "self_intersections.overlapping",
        "self_intersections.touching", "self_intersections.through_edges"})
    EXPECT_EQ(value(m, "validity." + std::string(name)), 0) << name;
  EXPECT_EQ(value(m, "validity.watertight"), 1);
}

}  // namespace atrium::metric
