#pragma once
#include <boost/graph/adjacency_list.hpp>
#include <boost/range/iterator_range.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "graph/api/node.hpp"

namespace atrium {

/// An output of a node: what edges come from.
struct Source {
  std::size_t node = 0;    ///< its vertex
  std::size_t output = 0;  ///< index into its type's outputs
};

/// A vertex of the dataflow: a node, sub-pipelines opened up.
struct PipelineNode {
  std::string path;                ///< its address: "planes", "shell/translate"
  const NodeType* type = nullptr;  ///< owned by the Registry
  std::vector<ParamValue> params;  ///< one per parameter of the type, defaults filled in, paths absolute
  std::uint64_t seed = 0;          ///< of its random streams: from the run's seed and the node's path
  std::filesystem::path folder;    ///< where it writes, relative to the run's folder
};

/// An edge of the dataflow: from an output of its source to an input of its target.
struct PipelineEdge {
  std::size_t output = 0;  ///< index into the source type's outputs
  std::size_t input = 0;   ///< index into the target type's inputs
  std::size_t place = 0;   ///< in the list of an input that takes several
};

struct PipelineOutput {
  std::string name;
  Source from;
};

/// What a dataflow says as a whole: graph[whole].
struct PipelineProperties {
  std::string summary;
  std::uint64_t seed = 1;
  std::filesystem::path file;
  std::vector<PipelineOutput> outputs;
};
inline constexpr boost::graph_bundle_t whole = boost::graph_bundle;

/// The one graph of a pipeline, from the file to the runner: files are parsed into it, sub-pipelines opened in it, it
/// is checked, merged for sweeps, pruned, drawn and run.
using Dataflow = boost::adjacency_list<boost::vecS, boost::vecS, boost::bidirectionalS, PipelineNode, PipelineEdge,
                                       PipelineProperties>;
using DataflowEdge = boost::graph_traits<Dataflow>::edge_descriptor;

inline std::size_t node_count(const Dataflow& graph) { return boost::num_vertices(graph); }
/// All nodes, 0 … node_count() − 1.
inline auto all_nodes(const Dataflow& graph) { return boost::make_iterator_range(boost::vertices(graph)); }
inline auto edges_into(std::size_t node, const Dataflow& graph) {
  return boost::make_iterator_range(boost::in_edges(node, graph));
}
inline auto edges_out_of(std::size_t node, const Dataflow& graph) {
  return boost::make_iterator_range(boost::out_edges(node, graph));
}
inline Source source_of(const DataflowEdge& edge, const Dataflow& graph) {
  return {boost::source(edge, graph), graph[edge].output};
}

inline std::size_t add_node(const PipelineNode& node, Dataflow& graph) { return boost::add_vertex(node, graph); }
inline void connect(Source from, std::size_t to, std::size_t input, std::size_t place, Dataflow& graph) {
  boost::add_edge(from.node, to, PipelineEdge{from.output, input, place}, graph);
}

/// What each input of the node reads, in the order of its list: 0, 1 or many.
std::vector<std::vector<Source>> inputs_of(std::size_t node, const Dataflow& graph);

/// The nodes in an order in which they can run; of several such orders the one that is nearest to the graph's own.
/// Throws Error if there is none.
std::vector<std::size_t> topological_order(const Dataflow& graph);

/// A shortest cycle through each group of nodes that lie on cycles: its edges in the direction of the data, the last
/// one into the group's first node.
std::vector<std::vector<DataflowEdge>> cycles_of(const Dataflow& graph);

/// The marked nodes and all that they read, directly or through others.
std::vector<bool> with_sources(const std::vector<bool>& marked, const Dataflow& graph);
/// The marked nodes and all that reads them, directly or through others.
std::vector<bool> with_readers(const std::vector<bool>& marked, const Dataflow& graph);

/// The graph of these nodes, in this order, with the edges between them and the outputs that come from them.
Dataflow part_of(const Dataflow& graph, const std::vector<std::size_t>& nodes);

}  // namespace atrium
