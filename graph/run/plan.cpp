#include "graph/run/plan.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/topological_sort.hpp>
#include <iterator>

namespace atrium {
namespace {

// Out-edges in a set: two edges between the same nodes are one wait.
using NodeGraph = boost::adjacency_list<boost::setS, boost::vecS, boost::bidirectionalS>;

std::vector<std::size_t> ends_first(const NodeGraph& graph) {
  std::vector<std::size_t> order;
  order.reserve(boost::num_vertices(graph));
  try {
    boost::topological_sort(graph, std::back_inserter(order));
  } catch (const boost::not_a_dag&) {
    throw Error("the nodes wait for each other in a circle");
  }
  return order;
}

}  // namespace

Plan make_plan(const Pipeline& pipeline) {
  const std::size_t size = pipeline.nodes.size();
  Plan plan{std::vector<std::vector<std::size_t>>(size), std::vector<std::size_t>(size),
            std::vector<std::size_t>(size, 1), std::vector<std::vector<std::size_t>>(size)};
  for (std::size_t n = 0; n < size; ++n) plan.readers[n].resize(pipeline.nodes[n].type->outputs.size());
  NodeGraph graph(size);
  for (std::size_t n = 0; n < size; ++n) {
    for (const auto& port : pipeline.nodes[n].inputs) {
      for (const Edge& edge : port) {
        boost::add_edge(edge.node, n, graph);
        ++plan.readers.at(edge.node).at(edge.output);
      }
    }
  }
  for (const auto& output : pipeline.outputs) ++plan.readers.at(output.from.node).at(output.from.output);
  for (const std::size_t n : ends_first(graph)) {
    plan.waits[n] = boost::in_degree(n, graph);
    for (const auto [next, end] = boost::adjacent_vertices(n, graph);
         const std::size_t f : boost::make_iterator_range(next, end)) {
      plan.followers[n].push_back(f);
      plan.remaining[n] = std::max(plan.remaining[n], plan.remaining[f] + 1);
    }
  }
  return plan;
}

}  // namespace atrium
