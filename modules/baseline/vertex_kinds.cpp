#include "modules/baseline/vertex_kinds.hpp"

#include <algorithm>
#include <array>

namespace atrium::baseline {
namespace {

// The two edges of a triangle at a vertex: numbers k of FaceNeighbours.
std::array<std::size_t, 2> edges_at(const std::array<std::uint32_t, 3>& triangle, std::uint32_t vertex) {
  const std::size_t k = triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
  return {k, (k + 2) % 3};
}

class Classifier {
 public:
  Classifier(const Mesh& mesh, const FaceNeighbours& neighbours, const std::vector<std::int32_t>& region)
      : mesh_(mesh), neighbours_(neighbours), region_(region) {}

  VertexKind kind(std::uint32_t vertex, const std::vector<std::uint32_t>& faces) const {
    VertexKind kind{0, 0, true};
    if (faces.empty()) return kind;
    kind.low = kind.high = region_[faces[0]];
    int border_sides = 0;  // of border edges, seen from each triangle
    bool more = false;
    const auto meet = [&](std::int32_t r) {
      if (kind.low == kind.high && r != kind.low) {
        (r < kind.low ? kind.low : kind.high) = r;
      } else if (r != kind.low && r != kind.high) {
        more = true;
      }
    };
    for (const auto f : faces) {
      meet(region_[f]);
      for (const auto k : edges_at(mesh_.triangles[f], vertex)) {
        const auto n = neighbours_.of[f][k];
        if (n == FaceNeighbours::several) return kind;
        if (n == FaceNeighbours::none) meet(outside);
        if (n == FaceNeighbours::none) border_sides += 2;
        if (n < FaceNeighbours::several && region_[n] != region_[f]) ++border_sides;
      }
    }
    const int sides_wanted = kind.low == kind.high ? 0 : 4;
    kind.fixed = more || border_sides != sides_wanted || !one_fan(vertex, faces);
    return kind;
  }

 private:
  // Whether the triangles hang together over the edges at the vertex.
  bool one_fan(std::uint32_t vertex, const std::vector<std::uint32_t>& faces) const {
    std::vector<std::uint32_t> reached{faces[0]};
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const auto k : edges_at(mesh_.triangles[reached[i]], vertex)) {
        const auto n = neighbours_.of[reached[i]][k];
        if (n < FaceNeighbours::several && std::find(reached.begin(), reached.end(), n) == reached.end())
          reached.push_back(n);
      }
    return reached.size() == faces.size();
  }

  const Mesh& mesh_;
  const FaceNeighbours& neighbours_;
  const std::vector<std::int32_t>& region_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> faces_of_vertices(const Mesh& mesh) {
  std::vector<std::uint32_t> counts(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const auto v : t) ++counts[v];
  std::vector<std::vector<std::uint32_t>> faces(mesh.vertices.size());
  for (std::size_t v = 0; v < faces.size(); ++v) faces[v].reserve(counts[v]);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const auto v : mesh.triangles[t]) faces[v].push_back(t);
  return faces;
}

std::vector<VertexKind> vertex_kinds(const Mesh& mesh, const std::vector<std::vector<std::uint32_t>>& faces,
                                     const FaceNeighbours& neighbours, const std::vector<std::int32_t>& region,
                                     const Context& context) {
  std::vector<VertexKind> kinds(mesh.vertices.size());
  const Classifier classifier(mesh, neighbours, region);
  context.parallel_for(kinds.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) kinds[v] = classifier.kind(static_cast<std::uint32_t>(v), faces[v]);
  });
  return kinds;
}

}  // namespace atrium::baseline
