#include "modules/types/adjacency.hpp"

#include <algorithm>

namespace atrium {

std::pair<std::uint64_t, std::vector<Adjacency::Edge>> Adjacency::contents(const Adjacency& adjacency) {
  return {boost::num_vertices(adjacency.graph), adjacency.edges()};
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
