#include "modules/types/adjacency.hpp"

#include <algorithm>

#include "graph/api/error.hpp"

namespace atrium {

Adjacency::Contents Adjacency::contents(const Adjacency& adjacency) {
  return {boost::num_vertices(adjacency.graph), adjacency.edges()};
}

Adjacency Adjacency::from_contents(const Contents& contents) {
  Adjacency adjacency{Graph(contents.first)};
  for (const Edge& edge : contents.second) {
    if (edge.a >= contents.first || edge.b >= contents.first)
      throw Error("an edge leads to a vertex that is not there");
    boost::add_edge(edge.a, edge.b, AdjacencyEdge{edge.separation}, adjacency.graph);
  }
  return adjacency;
}

std::vector<Adjacency::Edge> Adjacency::edges() const {
  std::vector<Edge> result;
  for (auto [it, end] = boost::edges(graph); it != end; ++it) {
    const std::uint64_t s = boost::source(*it, graph);
    const std::uint64_t t = boost::target(*it, graph);
    result.push_back({std::min(s, t), std::max(s, t), graph[*it].separation});
  }
  std::sort(result.begin(), result.end(),
            [](const Edge& l, const Edge& r) { return std::tie(l.a, l.b) < std::tie(r.a, r.b); });
  return result;
}

std::vector<std::size_t> Adjacency::neighbours(std::size_t mesh) const {
  std::vector<std::size_t> result;
  for (auto [it, end] = boost::adjacent_vertices(mesh, graph); it != end; ++it) result.push_back(*it);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace atrium
