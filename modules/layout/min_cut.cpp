#include "modules/layout/min_cut.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

namespace atrium::layout {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
struct Vertex {
  boost::default_color_type colour{};
  Traits::edge_descriptor predecessor;
  double distance = 0;
};
struct Edge {
  double capacity = 0, residual = 0;
  Traits::edge_descriptor reverse;
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Vertex, Edge>;

void connect(Graph& graph, std::size_t a, std::size_t b, double forward, double backward) {
  const auto there = boost::add_edge(a, b, graph).first;
  const auto back = boost::add_edge(b, a, graph).first;
  graph[there].capacity = forward;
  graph[back].capacity = backward;
  graph[there].reverse = back;
  graph[back].reverse = there;
}

}  // namespace

void MinCut::add(std::size_t element, double cost_of_zero, double cost_of_one) {
  zero_[element] += cost_of_zero;
  one_[element] += cost_of_one;
}

void MinCut::add_pair(std::size_t a, std::size_t b, double cost_01, double cost_10) {
  if (cost_01 > 0 || cost_10 > 0) pairs_.push_back({a, b, cost_01, cost_10});
}

std::vector<bool> MinCut::solve() const {
  const std::size_t elements = zero_.size();
  Graph graph(elements + 2);
  const std::size_t source = elements, sink = elements + 1;  // 1 is the source's side
  for (std::size_t i = 0; i < elements; ++i) {
    const double least = std::min(zero_[i], one_[i]);
    if (zero_[i] > least) connect(graph, source, i, zero_[i] - least, 0);
    if (one_[i] > least) connect(graph, i, sink, one_[i] - least, 0);
  }
  for (const auto& pair : pairs_) connect(graph, pair.a, pair.b, pair.cost_10, pair.cost_01);
  boost::boykov_kolmogorov_max_flow(graph, boost::get(&Edge::capacity, graph), boost::get(&Edge::residual, graph),
                                    boost::get(&Edge::reverse, graph), boost::get(&Vertex::predecessor, graph),
                                    boost::get(&Vertex::colour, graph), boost::get(&Vertex::distance, graph),
                                    boost::get(boost::vertex_index, graph), source, sink);
  std::vector<bool> labels(elements);
  for (std::size_t i = 0; i < elements; ++i) labels[i] = graph[i].colour == graph[source].colour;
  return labels;
}

}  // namespace atrium::layout
