#include "merged_regions.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace atrium::baseline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corner = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Cell =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Corner, Cell>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Vertices = std::vector<std::array<double, 3>>;

Eigen::Vector3d place(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

/// The edges that only one polygon of the region has, from corner to corner.
std::set<Edge> outline(const PlanarPieces& pieces, const std::vector<std::size_t>& members) {
  std::set<Edge> edges;
  for (const std::size_t m : members) {
    const auto& polygon = pieces.polygons[m];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Edge edge{polygon[k], polygon[(k + 1) % polygon.size()]};
      if (edges.erase({edge.second, edge.first}) == 0) edges.insert(edge);
    }
  }
  return edges;
}

/// Corners at which more or less than two edges of the outlines meet.
std::vector<bool> kept_corners(const std::vector<std::set<Edge>>& outlines, std::size_t corners) {
  std::set<Edge> all;
  for (const auto& edges : outlines)
    for (const auto& [a, b] : edges) all.insert(std::minmax(a, b));
  std::vector<int> degree(corners, 0);
  for (const auto& [a, b] : all) {
    ++degree[a];
    ++degree[b];
  }
  std::vector<bool> kept(corners);
  for (std::size_t i = 0; i < corners; ++i) kept[i] = degree[i] != 2;
  return kept;
}

/// The outline with its left-out corners passed over.
std::vector<Edge> straightened(const std::set<Edge>& edges, const std::vector<bool>& kept) {
  std::map<std::uint32_t, std::uint32_t> next;  // of the left-out corners
  for (const auto& [a, b] : edges)
    if (!kept[a]) next[a] = b;
  std::vector<Edge> result;
  for (const auto& [a, b] : edges) {
    if (!kept[a]) continue;
    std::uint32_t end = b;
    while (!kept[end]) end = next.at(end);
    result.emplace_back(a, end);
  }
  return result;
}

Eigen::Vector3d region_normal(const PlanarPieces& pieces, const std::vector<std::size_t>& members) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t m : members) {
    const auto& polygon = pieces.polygons[m];
    const Eigen::Vector3d first = place(pieces.vertices[polygon[0]]);
    for (std::size_t k = 2; k < polygon.size(); ++k)
      sum += (place(pieces.vertices[polygon[k - 1]]) - first).cross(place(pieces.vertices[polygon[k]]) - first);
  }
  return sum.normalized();
}

/// Depth of every cell: how many constraints lie between it and the outside.
void measure_depth(Triangulation& triangulation) {
  for (const auto& cell : triangulation.all_face_handles()) cell->info() = -1;
  std::vector<Triangulation::Face_handle> layer{triangulation.infinite_face()};
  for (int depth = 0; !layer.empty(); ++depth) {
    std::vector<Triangulation::Face_handle> deeper;
    while (!layer.empty()) {
      const auto cell = layer.back();
      layer.pop_back();
      if (cell->info() != -1) continue;
      cell->info() = depth;
      for (int i = 0; i < 3; ++i) {
        const auto neighbour = cell->neighbor(i);
        if (neighbour->info() == -1) (cell->is_constrained(i) ? deeper : layer).push_back(neighbour);
      }
    }
    layer = std::move(deeper);
  }
}

std::vector<std::array<std::uint32_t, 3>> triangulated(const std::vector<Edge>& edges, const Vertices& vertices,
                                                       const Eigen::Vector3d& normal) {
  const Eigen::Vector3d across = normal.unitOrthogonal();
  const Eigen::Vector3d up = normal.cross(across);
  Triangulation triangulation;
  std::map<std::uint32_t, Triangulation::Vertex_handle> handles;
  for (const auto& [a, b] : edges)
    for (const std::uint32_t i : {a, b}) {
      if (handles.contains(i)) continue;
      const Eigen::Vector3d p = place(vertices[i]);
      handles[i] = triangulation.insert({p.dot(across), p.dot(up)});
      handles[i]->info() = i;
    }
  for (const auto& [a, b] : edges) triangulation.insert_constraint(handles[a], handles[b]);
  measure_depth(triangulation);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& cell : triangulation.finite_face_handles())
    if (cell->info() % 2 == 1)
      triangles.push_back({cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info()});
  return triangles;
}

}  // namespace

MergedRegions merge_regions(const PlanarPieces& pieces) {
  const auto last = std::max_element(pieces.regions.begin(), pieces.regions.end());
  const std::size_t count = last == pieces.regions.end() ? 0 : static_cast<std::size_t>(*last) + 1;
  std::vector<std::vector<std::size_t>> members(count);
  for (std::size_t i = 0; i < pieces.polygons.size(); ++i) members[pieces.regions[i]].push_back(i);
  std::vector<std::set<Edge>> outlines;
  outlines.reserve(count);
  for (const auto& region : members) outlines.push_back(outline(pieces, region));
  const std::vector<bool> kept = kept_corners(outlines, pieces.vertices.size());

  MergedRegions merged;
  std::map<std::uint32_t, std::uint32_t> numbers;
  const auto number = [&](std::uint32_t corner) {
    const auto [found, fresh] = numbers.try_emplace(corner, static_cast<std::uint32_t>(merged.vertices.size()));
    if (fresh) merged.vertices.push_back(pieces.vertices[corner]);
    return found->second;
  };
  for (std::size_t r = 0; r < count; ++r) {
    const auto edges = straightened(outlines[r], kept);
    for (const auto& [a, b, c] : triangulated(edges, pieces.vertices, region_normal(pieces, members[r]))) {
      const std::uint32_t first = number(a);
      const std::uint32_t second = number(b);
      merged.triangles.push_back({first, second, number(c)});
      merged.regions.push_back(static_cast<std::int32_t>(r));
    }
  }
  return merged;
}

}  // namespace atrium::baseline
