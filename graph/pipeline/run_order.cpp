#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>
#include <boost/graph/topological_sort.hpp>
#include <deque>

#include "graph/pipeline/expansion.hpp"

namespace atrium {
namespace {

/// From each node to those that it reads: a depth-first search then finishes sources before readers.
using OrderGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;

OrderGraph build(const Expansion& expansion) {
  OrderGraph graph(expansion.nodes.size());
  for (std::size_t i = 0; i < expansion.nodes.size(); ++i)
    for (const auto& port : expansion.nodes[i].inputs)
      for (const auto& edge : port) boost::add_edge(i, edge.from.node, graph);
  return graph;
}

/// The edges of a shortest cycle through `start` within its component, in the direction of the data, last edge into
/// start.
std::vector<const FlatEdge*> shortest_cycle(const Expansion& expansion, const std::vector<int>& component,
                                            std::size_t start) {
  std::vector<const FlatEdge*> via(expansion.nodes.size(),
                                   nullptr);  // how the search, against the data, came to a node
  std::vector<std::size_t> reader(expansion.nodes.size(), start);
  std::deque<std::size_t> queue{start};
  while (!queue.empty()) {
    const std::size_t node = queue.front();
    queue.pop_front();
    for (const auto& port : expansion.nodes[node].inputs)
      for (const auto& edge : port) {
        const std::size_t source = edge.from.node;
        if (component[source] != component[start] || via[source] != nullptr) continue;
        via[source] = &edge;
        reader[source] = node;
        if (source != start) {
          queue.push_back(source);
          continue;
        }
        std::vector<const FlatEdge*> cycle;
        for (std::size_t at = start; cycle.empty() || at != start; at = reader[at]) cycle.push_back(via[at]);
        return cycle;
      }
  }
  return {};
}

void report_cycles(const Expansion& expansion, const OrderGraph& graph, Findings& findings) {
  std::vector<int> component(expansion.nodes.size());
  const int count = boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), boost::get(boost::vertex_index, graph)));
  std::vector<bool> seen(static_cast<std::size_t>(count), false);
  for (std::size_t i = 0; i < expansion.nodes.size(); ++i) {
    const auto c = static_cast<std::size_t>(component[i]);
    if (seen[c]) continue;
    seen[c] = true;
    const auto cycle = shortest_cycle(expansion, component, i);
    if (cycle.empty()) continue;
    std::string path;
    for (const auto* edge : cycle) {
      const FlatNode& source = expansion.nodes[edge->from.node];
      path += fmt::format("{}.{} → ", source.path, source.type->outputs[edge->from.output].name);
    }
    findings.error(cycle.back()->where, fmt::format("the nodes form a cycle: {}{}", path, expansion.nodes[i].path),
                   "one of these edges must go");
  }
}

}  // namespace

std::vector<std::size_t> run_order(const Expansion& expansion, Findings& findings) {
  const OrderGraph graph = build(expansion);
  std::vector<std::size_t> order;
  order.reserve(expansion.nodes.size());
  try {
    boost::topological_sort(graph, std::back_inserter(order));
  } catch (const boost::not_a_dag&) {
    order.clear();
    report_cycles(expansion, graph, findings);
  }
  return order;
}

}  // namespace atrium
