#include "graph/pipeline/dataflow.hpp"

#include <algorithm>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/depth_first_search.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/graph/reverse_graph.hpp>
#include <boost/graph/strong_components.hpp>
#include <boost/graph/topological_sort.hpp>
#include <functional>
#include <iterator>
#include <optional>

namespace atrium {
namespace {

/// What can be reached from the marked nodes, themselves included.
template <class Graph>
std::vector<bool> reachable(const std::vector<bool>& marked, const Graph& graph) {
  std::vector<boost::default_color_type> colours(marked.size(), boost::white_color);
  const auto colour = boost::make_iterator_property_map(colours.begin(), boost::get(boost::vertex_index, graph));
  for (std::size_t n = 0; n < marked.size(); ++n)
    if (marked[n] && colours[n] == boost::white_color)
      boost::depth_first_visit(graph, n, boost::default_dfs_visitor(), colour);
  std::vector<bool> result;
  result.reserve(colours.size());
  for (const auto c : colours) result.push_back(c != boost::white_color);
  return result;
}

/// Ends a breadth-first search at the first edge that leads back to its start.
struct Closed {
  DataflowEdge edge;
};
class CycleFinder : public boost::default_bfs_visitor {
 public:
  CycleFinder(std::size_t start, std::vector<DataflowEdge>& via) : start_(start), via_(via) {}
  template <class Graph>
  void examine_edge(DataflowEdge edge, const Graph& graph) const {
    if (boost::target(edge, graph) == start_) throw Closed{edge};
  }
  template <class Graph>
  void tree_edge(DataflowEdge edge, const Graph& graph) const {
    via_[boost::target(edge, graph)] = edge;
  }

 private:
  std::size_t start_;
  std::vector<DataflowEdge>& via_;
};

std::vector<DataflowEdge> shortest_cycle(std::size_t start, const std::vector<int>& component, const Dataflow& graph) {
  const std::function<bool(std::size_t)> same = [&](std::size_t n) { return component[n] == component[start]; };
  const boost::filtered_graph<Dataflow, boost::keep_all, std::function<bool(std::size_t)>> group(
      graph, boost::keep_all(), same);
  std::vector<DataflowEdge> via(component.size());
  try {
    boost::breadth_first_search(group, start, boost::visitor(CycleFinder(start, via)));
  } catch (const Closed& closed) {
    std::vector<DataflowEdge> cycle{closed.edge};
    for (std::size_t n = boost::source(closed.edge, graph); n != start; n = boost::source(cycle.back(), graph))
      cycle.push_back(via[n]);
    std::reverse(cycle.begin(), cycle.end());
    return cycle;
  }
  return {};
}

}  // namespace

std::vector<std::vector<Source>> inputs_of(std::size_t node, const Dataflow& graph) {
  std::vector<std::vector<Source>> inputs(graph[node].type->inputs.size());
  for (const auto& edge : edges_into(node, graph)) {
    auto& list = inputs[graph[edge].input];
    if (list.size() <= graph[edge].place) list.resize(graph[edge].place + 1);
    list[graph[edge].place] = source_of(edge, graph);
  }
  return inputs;
}

std::vector<std::size_t> topological_order(const Dataflow& graph) {
  std::vector<std::size_t> order;
  order.reserve(node_count(graph));
  try {
    // Against the data a depth-first search finishes what a node reads before the node itself.
    const auto against = boost::make_reverse_graph(graph);
    boost::topological_sort(against, std::back_inserter(order));
  } catch (const boost::not_a_dag&) {
    throw Error("the nodes wait for each other in a circle");
  }
  return order;
}

std::vector<std::vector<DataflowEdge>> cycles_of(const Dataflow& graph) {
  try {  // most graphs have none, which this finds out sooner
    topological_order(graph);
    return {};
  } catch (const Error&) {
  }
  std::vector<int> component(node_count(graph));
  const int count = boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), boost::get(boost::vertex_index, graph)));
  std::vector<bool> closed(static_cast<std::size_t>(count), false);  // has an edge within
  for (const auto& edge : boost::make_iterator_range(boost::edges(graph)))
    if (const int c = component[boost::source(edge, graph)]; c == component[boost::target(edge, graph)])
      closed[static_cast<std::size_t>(c)] = true;
  std::vector<std::vector<DataflowEdge>> cycles;
  for (const std::size_t n : all_nodes(graph)) {
    const auto c = static_cast<std::size_t>(component[n]);
    if (!closed[c]) continue;
    closed[c] = false;
    if (auto cycle = shortest_cycle(n, component, graph); !cycle.empty()) cycles.push_back(std::move(cycle));
  }
  return cycles;
}

std::vector<bool> with_sources(const std::vector<bool>& marked, const Dataflow& graph) {
  return reachable(marked, boost::make_reverse_graph(graph));
}
std::vector<bool> with_readers(const std::vector<bool>& marked, const Dataflow& graph) {
  return reachable(marked, graph);
}

Dataflow part_of(const Dataflow& graph, const std::vector<std::size_t>& nodes) {
  constexpr std::size_t none = ~std::size_t{0};
  std::vector<std::size_t> place(node_count(graph), none);
  Dataflow part(nodes.size());
  part[whole].summary = graph[whole].summary;
  part[whole].seed = graph[whole].seed;
  part[whole].file = graph[whole].file;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    place[nodes[i]] = i;
    part[i] = graph[nodes[i]];
  }
  for (const std::size_t n : nodes)
    for (const auto& edge : edges_into(n, graph))
      if (const std::size_t from = place[boost::source(edge, graph)]; from != none)
        boost::add_edge(from, place[n], graph[edge], part);
  for (const auto& output : graph[whole].outputs)
    if (place[output.from.node] != none)
      part[whole].outputs.push_back({output.name, {place[output.from.node], output.from.output}});
  return part;
}

}  // namespace atrium
