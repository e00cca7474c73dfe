#pragma once
#include <cstdint>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace atrium {

/// The paper's G = (V, E): vertex i is meshes[i] of the PlaneMeshes that it was made from; an edge joins two meshes
/// that are nearer to each other than th_sep.
class Adjacency {
 public:
  static constexpr std::string_view port_type = "Adjacency";
  struct Edge {
    static constexpr auto members() { return std::tuple{&Edge::a, &Edge::b, &Edge::separation}; }
    std::uint64_t a, b;
    double separation;  ///< least distance between the two polygons, metres
  };

  Adjacency() = default;
  /// No edges yet.
  explicit Adjacency(std::size_t vertices) : neighbours_(vertices) {}
  /// Adds an edge between two different vertices. Throws Error if one of them is not there.
  void connect(std::size_t a, std::size_t b, double separation);

  std::size_t vertices() const { return neighbours_.size(); }
  /// All edges with a < b, ascending: the order in which algorithms walk them.
  std::vector<Edge> edges() const;
  /// Neighbours of a mesh, ascending.
  std::vector<std::size_t> neighbours(std::size_t mesh) const;

  /// For each vertex the neighbours with a higher number, ascending, and how far they are. A stored form in which a
  /// number stood for the vertices would have to be believed.
  using Contents = std::vector<std::vector<std::pair<std::uint64_t, double>>>;
  static Contents contents(const Adjacency& adjacency);
  static Adjacency from_contents(const Contents& contents);

 private:
  struct Neighbour {
    std::size_t mesh;
    double separation;
  };
  std::vector<std::vector<Neighbour>> neighbours_;  // of each vertex
};

}  // namespace atrium
