#pragma once
#include <boost/graph/adjacency_list.hpp>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

namespace atrium {

struct AdjacencyEdge {
  double separation = 0;  ///< least distance between the two polygons, metres
};

/// The paper's G = (V, E): vertex i is meshes[i] of the PlaneMeshes that it was made from; an edge joins two meshes
/// that are nearer to each other than th_sep.
struct Adjacency {
  static constexpr std::string_view port_type = "Adjacency";
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property, AdjacencyEdge>;
  struct Edge {
    static constexpr auto members() { return std::tuple{&Edge::a, &Edge::b, &Edge::separation}; }
    std::uint64_t a, b;
    double separation;
  };

  Graph graph;

  /// Number of vertices and edges: a Boost graph has no fields to list.
  using Contents = std::pair<std::uint64_t, std::vector<Edge>>;
  static Contents contents(const Adjacency& adjacency);
  static Adjacency from_contents(const Contents& contents);

  /// All edges with a < b, ascending: the order in which algorithms walk them.
  std::vector<Edge> edges() const;
  /// Neighbours of a mesh, ascending.
  std::vector<std::size_t> neighbours(std::size_t mesh) const;
};

}  // namespace atrium
