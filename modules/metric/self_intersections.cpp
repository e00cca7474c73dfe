#include "modules/metric/self_intersections.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "modules/geometry/box_tree.hpp"
#include "modules/geometry/exact_sign.hpp"

namespace atrium::metric {
namespace {

using Edge = std::array<std::uint32_t, 2>;  // the lower vertex first

// An edge that runs in the inside of a face, and the side of it on which one of the edge's own faces lies.
struct EdgeInFace {
  Edge edge;
  std::uint32_t face;
  int side;
  friend bool operator<(const EdgeInFace& a, const EdgeInFace& b) {
    return std::tie(a.edge, a.face, a.side) < std::tie(b.edge, b.face, b.side);
  }
};

struct Part {
  SelfIntersections found;
  std::vector<EdgeInFace> in_faces;
  std::vector<std::array<Edge, 2>> on_edges;  // two that share a piece
};

class Pairs {
 public:
  Pairs(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& triangles, double deep)
      : vertices_(vertices), triangles_(triangles), deep_(deep) {}

  Corners corners(std::uint32_t t) const {
    return {vertices_[triangles_[t][0]], vertices_[triangles_[t][1]], vertices_[triangles_[t][2]]};
  }
  void look_at(std::uint32_t a, std::uint32_t b, Part& part) const {
    if (same_corners(a, b)) return;
    const Corners at_a = corners(a), at_b = corners(b);
    const auto how = meeting(at_a, at_b);
    if (how == Meeting::apart) return;
    if (how == Meeting::overlap) ++part.found.overlaps;
    if (how == Meeting::crossing) {
      ++part.found.crossings;
      if (crossing_depth(at_a, at_b) > deep_) ++part.found.deep_crossings;
    }
    if (how == Meeting::touching) {
      ++part.found.touches;
      add_edges_in_face(a, b, part);
      add_edges_in_face(b, a, part);
      add_edges_on_edges(a, b, part);
    }
    part.found.triangles.insert(part.found.triangles.end(), {a, b});
  }

  // Of the faces at an edge in the inside of a face, some lie before and some behind it.
  static void through_faces(std::vector<EdgeInFace>& in_faces, std::vector<Edge>& through) {
    std::sort(in_faces.begin(), in_faces.end());
    for (std::size_t i = 0; i < in_faces.size();) {
      std::size_t end = i;
      while (end < in_faces.size() && in_faces[end].edge == in_faces[i].edge && in_faces[end].face == in_faces[i].face)
        ++end;
      if (in_faces[i].side < 0 && in_faces[end - 1].side > 0) through.push_back(in_faces[i].edge);
      i = end;
    }
  }

  // Both edges have two faces, and they take turns round the line.
  void through_edges(std::vector<std::array<Edge, 2>>& on_edges, std::vector<Edge>& through) const {
    if (on_edges.empty()) return;
    std::sort(on_edges.begin(), on_edges.end());
    on_edges.erase(std::unique(on_edges.begin(), on_edges.end()), on_edges.end());
    const auto uses = edge_uses(triangles_);
    const auto strip = [&](const Edge& edge, std::array<Eigen::Vector3d, 2>& apexes) {
      const auto at = std::lower_bound(uses.begin(), uses.end(), EdgeUse{edge[0], edge[1], 0, true});
      const auto count = std::min<std::ptrdiff_t>(3, uses.end() - at);
      std::ptrdiff_t own = 0;
      for (; own < count && at[own].same_edge({edge[0], edge[1], 0, true}); ++own) {
        if (own == 2) break;
        for (const auto v : triangles_[at[own].triangle])
          if (v != edge[0] && v != edge[1]) apexes[static_cast<std::size_t>(own)] = vertices_[v];
      }
      return own == 2 && (count < 3 || !at[2].same_edge(at[0]));
    };
    for (const auto& [one, other] : on_edges) {
      std::array<Eigen::Vector3d, 2> at_one, at_other;
      if (!strip(one, at_one) || !strip(other, at_other)) continue;
      if (strips_cross(vertices_[one[0]], vertices_[one[1]], at_one, at_other))
        through.insert(through.end(), {one, other});
    }
  }

 private:
  bool same_corners(std::uint32_t a, std::uint32_t b) const {
    Triangle s = triangles_[a], t = triangles_[b];
    std::sort(s.begin(), s.end());
    std::sort(t.begin(), t.end());
    return s == t;
  }
  Edge edge(std::uint32_t t, std::size_t i) const {
    const auto p = triangles_[t][i], q = triangles_[t][(i + 1) % 3];
    return {std::min(p, q), std::max(p, q)};
  }
  void add_edges_in_face(std::uint32_t of, std::uint32_t face, Part& part) const {
    const Corners own = corners(of), f = corners(face);
    std::array<int, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) side[i] = plane_side(f[0], f[1], f[2], own[i]);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = (i + 1) % 3, apex = (i + 2) % 3;
      if (side[i] == 0 && side[k] == 0 && side[apex] != 0 && enters(own[i], own[k], f))
        part.in_faces.push_back({edge(of, i), face, side[apex]});
    }
  }
  void add_edges_on_edges(std::uint32_t a, std::uint32_t b, Part& part) const {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge e = edge(a, i), f = edge(b, k);
        if (e != f && share_piece(vertices_[e[0]], vertices_[e[1]], vertices_[f[0]], vertices_[f[1]]))
          part.on_edges.push_back(e < f ? std::array{e, f} : std::array{f, e});
      }
  }

  const std::vector<Eigen::Vector3d>& vertices_;
  const std::vector<Triangle>& triangles_;
  double deep_;
};

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}
template <class T>
void keep_distinct(std::vector<T>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

}  // namespace

SelfIntersections self_intersections(const std::vector<Eigen::Vector3d>& vertices,
                                     const std::vector<Triangle>& triangles, double deep, const Context& context) {
  std::vector<Eigen::AlignedBox3d> boxes(triangles.size());
  for (std::uint32_t t = 0; t < boxes.size(); ++t)
    for (const auto v : triangles[t]) boxes[t].extend(vertices[v]);
  const BoxTree tree(boxes, context);
  const Pairs pairs(vertices, triangles, deep);
  constexpr std::size_t chunk_size = 1024;
  std::vector<Part> parts((triangles.size() + chunk_size - 1) / chunk_size);
  context.parallel_chunks(triangles.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (auto a = static_cast<std::uint32_t>(begin); a < end; ++a)
      tree.meeting(boxes[a], [&](std::uint32_t b) {
        if (b > a) pairs.look_at(a, b, parts[chunk]);
      });
  });
  Part all;
  for (const auto& p : parts) {
    all.found.crossings += p.found.crossings;
    all.found.deep_crossings += p.found.deep_crossings;
    all.found.overlaps += p.found.overlaps;
    all.found.touches += p.found.touches;
    append(all.found.triangles, p.found.triangles);
    append(all.in_faces, p.in_faces);
    append(all.on_edges, p.on_edges);
  }
  std::vector<Edge> through;
  Pairs::through_faces(all.in_faces, through);
  pairs.through_edges(all.on_edges, through);
  keep_distinct(through);
  all.found.through_edges = through.size();
  keep_distinct(all.found.triangles);
  return all.found;
}

}  // namespace atrium::metric
