#include "modules/types/adjacency.hpp"

#include <algorithm>

#include "graph/api/error.hpp"

namespace atrium {

void Adjacency::connect(std::size_t a, std::size_t b, double separation) {
  if (a >= vertices() || b >= vertices() || a == b) throw Error("an edge leads to a vertex that is not there");
  neighbours_[a].push_back({b, separation});
  neighbours_[b].push_back({a, separation});
}

std::vector<Adjacency::Edge> Adjacency::edges() const {
  std::vector<Edge> result;
  for (std::size_t a = 0; a < vertices(); ++a)
    for (const Neighbour& b : neighbours_[a])
      if (a < b.mesh) result.push_back({a, b.mesh, b.separation});
  std::sort(result.begin(), result.end(),
            [](const Edge& l, const Edge& r) { return std::tie(l.a, l.b) < std::tie(r.a, r.b); });
  return result;
}

std::vector<std::size_t> Adjacency::neighbours(std::size_t mesh) const {
  std::vector<std::size_t> result;
  for (const Neighbour& neighbour : neighbours_[mesh]) result.push_back(neighbour.mesh);
  std::sort(result.begin(), result.end());
  return result;
}

Adjacency::Contents Adjacency::contents(const Adjacency& adjacency) {
  Contents contents(adjacency.vertices());
  for (const Edge& edge : adjacency.edges()) contents[edge.a].emplace_back(edge.b, edge.separation);
  return contents;
}

Adjacency Adjacency::from_contents(const Contents& contents) {
  Adjacency adjacency(contents.size());
  for (std::size_t a = 0; a < contents.size(); ++a)
    for (const auto& [b, separation] : contents[a]) adjacency.connect(a, b, separation);
  return adjacency;
}

}  // namespace atrium
