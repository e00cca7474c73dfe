#pragma once
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <numeric>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::metric {

using Triangle = std::array<std::uint32_t, 3>;

/// For each vertex the least index of those at its place: exactly the same coordinates (−0 is 0), or, with a tolerance
/// above 0, all that hang together over steps of at most that distance.
std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3d>& vertices, double tolerance, const Context& context);

/// A use of an edge by a triangle.
struct EdgeUse {
  std::uint32_t low, high;  ///< its vertices
  std::uint32_t triangle;
  bool forward;  ///< the triangle runs from low to high
  friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  }
  bool same_edge(const EdgeUse& o) const { return low == o.low && high == o.high; }
};

/// The edges of the triangles, sorted, so that the uses of one edge stand together. Triangles that name a vertex twice
/// are left out.
std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles);

/// Calls visit(first, last) for the uses of each edge.
template <class Visit>
void each_edge(const std::vector<EdgeUse>& uses, Visit visit) {
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i + 1;
    while (end < uses.size() && uses[end].same_edge(uses[i])) ++end;
    visit(uses.data() + i, uses.data() + end);
    i = end;
  }
}

/// Elements 0, 1, … in groups that grow together.
class Groups {
 public:
  explicit Groups(std::size_t size) : rank_(size, 0), parent_(size), sets_(rank_.data(), parent_.data()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  Groups(const Groups&) = delete;
  Groups& operator=(const Groups&) = delete;
  void join(std::uint32_t a, std::uint32_t b) { sets_.union_set(a, b); }
  /// One element that stands for the group of `a`.
  std::uint32_t of(std::uint32_t a) { return sets_.find_set(a); }

 private:
  std::vector<std::uint32_t> rank_, parent_;
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> sets_;
};

/// A mesh with welded vertices and without degenerate faces.
struct WeldedMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< all of the mesh's, whether a triangle uses them or not
  std::vector<Triangle> triangles;        ///< those that have an area, exactly
  std::vector<std::uint32_t> source;      ///< their indices in the mesh
  std::vector<bool> duplicate;            ///< per triangle: has the same three corners as an earlier one
  std::size_t degenerate = 0, duplicates = 0;

  double area(std::size_t triangle) const;
};
WeldedMesh welded(const Mesh& mesh, double tolerance, const Context& context);

}  // namespace atrium::metric
