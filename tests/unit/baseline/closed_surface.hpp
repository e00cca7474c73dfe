#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// What a closed mesh encloses; positive when its triangles are counter-clockwise seen from outside.
inline double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  return sum;
}

/// Every edge has two triangles, which run along it in opposite directions.
inline bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end() && back->second == 1;
  });
}

}  // namespace atrium::baseline
