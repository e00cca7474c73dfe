#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/baseline/planar_partition.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// A mesh whose edges are collapsed: its places and triangles, the triangles at each vertex, and the conditions under
/// which an edge may go.
class CollapsingMesh {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  /// Both must outlive it. No triangle may have a corner twice.
  CollapsingMesh(const Mesh& mesh, const PlanarPartition& partition);

  std::vector<Eigen::Vector3d>& places() { return places_; }
  const std::vector<Eigen::Vector3d>& places() const { return places_; }
  const Corners& corners(std::uint32_t face) const { return triangles_[face]; }
  /// Of each vertex; none: it is gone.
  const std::vector<std::uint32_t>& faces(std::uint32_t vertex) const { return faces_[vertex]; }
  const std::vector<std::vector<std::uint32_t>>& faces() const { return faces_; }
  std::size_t left() const { return left_; }
  Eigen::Vector3d area_vector(std::uint32_t face) const {
    const Corners& c = triangles_[face];
    return (places_[c[1]] - places_[c[0]]).cross(places_[c[2]] - places_[c[0]]);
  }

  /// The triangles at the edge from u to v; until the next call.
  const std::vector<std::uint32_t>& shared(std::uint32_t u, std::uint32_t v);
  /// Whether the collapse of the edge that shared() was last asked for keeps the topology: its ends have no neighbours
  /// in common but the triangles' third corners (Dey, Edelsbrunner, Guha and Nekhayev 1999).
  bool link_allows(std::uint32_t u, std::uint32_t v);
  /// Whether u's triangles without v keep their side and some thickness when u goes to `place`.
  bool stays_upright(std::uint32_t u, std::uint32_t v, const Eigen::Vector3d& place);
  /// From now on a triangle's side is that of the triangle itself, not that of its region's plane.
  void forget_planes() { by_planes_ = false; }
  /// u goes into v, and v to `place`; for the edge that shared() was last asked for.
  void merge(std::uint32_t u, std::uint32_t v, const Eigen::Vector3d& place);

  /// What is left, with the source's columns, and the regions as primitives.
  Mesh result() const;

 private:
  bool has(std::uint32_t face, std::uint32_t v) const {
    const Corners& c = triangles_[face];
    return c[0] == v || c[1] == v || c[2] == v;
  }
  bool spans_thirds(std::uint32_t end, std::uint32_t u, std::uint32_t v) const;
  std::uint32_t third(std::size_t k, std::uint32_t u, std::uint32_t v) const;
  bool same_side(std::uint32_t face, const Eigen::Vector3d& old, const Eigen::Vector3d& now) const;
  double thickness_of(std::uint32_t face) const;

  const Mesh& mesh_;
  const PlanarPartition& partition_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<Corners> triangles_;
  std::vector<char> alive_;
  std::vector<std::vector<std::uint32_t>> faces_;
  std::size_t left_;
  bool by_planes_ = true;
  std::vector<std::uint32_t> shared_, marks_;
  std::uint32_t mark_ = 0;
};

}  // namespace atrium::baseline
