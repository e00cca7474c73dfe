// atrium graph FILE: the pipeline as a drawing, for Graphviz (DOT) or Markdown (Mermaid).
#include <fmt/format.h>

#include <boost/graph/graphviz.hpp>
#include <boost/graph/transitive_reduction.hpp>
#include <iostream>
#include <map>

#include "graph/cli/verbs.hpp"
#include "graph/pipeline/pipeline.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium::cli {
namespace {

/// Sub-pipelines as a tree of folders, each with the nodes that stand in it.
struct Group {
  std::map<std::string, Group> groups;
  std::vector<std::size_t> nodes;
};

Group grouped(const Pipeline& pipeline) {
  Group root;
  for (const std::size_t n : all_nodes(pipeline)) {
    Group* group = &root;
    std::string_view rest = pipeline[n].path;
    for (std::size_t slash = rest.find('/'); slash != std::string_view::npos; slash = rest.find('/')) {
      group = &group->groups[std::string(rest.substr(0, slash))];
      rest.remove_prefix(slash + 1);
    }
    group->nodes.push_back(n);
  }
  return root;
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string edge_label(const Pipeline& pipeline, const DataflowEdge& edge) {
  const NodeType& from = *pipeline[boost::source(edge, pipeline)].type;
  const NodeType& to = *pipeline[boost::target(edge, pipeline)].type;
  const std::string& output = from.outputs[pipeline[edge].output].name;
  const std::string& input = to.inputs[pipeline[edge].input].name;
  return output == input ? output : fmt::format("{} → {}", output, input);
}

/// The pipeline without the edges that say no more of the order than others do: a → c beside a → b → c.
Pipeline reduced(const Pipeline& pipeline) {
  Dataflow necessary;
  std::vector<std::size_t> place(node_count(pipeline));
  const auto to_necessary = boost::make_iterator_property_map(place.begin(), boost::get(boost::vertex_index, pipeline));
  boost::transitive_reduction(pipeline, necessary, to_necessary, boost::get(boost::vertex_index, pipeline));
  Pipeline result = pipeline;
  boost::remove_edge_if(
      [&](const DataflowEdge& edge) {
        return !boost::edge(place[boost::source(edge, result)], place[boost::target(edge, result)], necessary).second;
      },
      result);
  return result;
}

/// Clusters name their nodes only: the nodes themselves follow.
void print_clusters(const Group& group, const std::string& path, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  for (const auto& [name, inner] : group.groups) {
    fmt::print("{}subgraph \"cluster_{}{}\" {{\n{}  label=\"{}\";\n", indent, path, name, indent, name);
    for (const std::size_t n : inner.nodes) fmt::print("{}  n{};\n", indent, n);
    print_clusters(inner, path + name + "/", depth + 1);
    fmt::print("{}}}\n", indent);
  }
}

void print_outputs(const Pipeline& pipeline) {
  const auto& outputs = pipeline[whole].outputs;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Source& from = outputs[i].from;
    fmt::print("  out{} [label=\"{}\", shape=oval];\n  n{} -> out{} [label=\"{}\"];\n", i, outputs[i].name, from.node,
               i, pipeline[from.node].type->outputs[from.output].name);
  }
}

void print_dot(const Pipeline& pipeline) {
  std::vector<std::string> names;
  for (const std::size_t n : all_nodes(pipeline)) names.push_back(fmt::format("n{}", n));
  const auto node = [&](std::ostream& out, std::size_t n) {
    out << fmt::format(" [label=\"{}\\n{}\"]", last_part(pipeline[n].path), pipeline[n].type->type);
  };
  const auto edge = [&](std::ostream& out, const DataflowEdge& e) {
    out << fmt::format(" [label=\"{}\"]", edge_label(pipeline, e));
  };
  const auto graph = [&](std::ostream& /*out*/) {
    fmt::print("  rankdir=LR;\n  node [shape=box];\n");
    print_clusters(grouped(pipeline), "", 1);
    print_outputs(pipeline);
    std::fflush(stdout);
  };
  boost::write_graphviz(std::cout, pipeline, node, edge, graph,
                        boost::make_iterator_property_map(names.begin(), boost::get(boost::vertex_index, pipeline)));
  std::cout.flush();
}

void print_mermaid_group(const Pipeline& pipeline, const Group& group, const std::string& path, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  for (const std::size_t n : group.nodes)
    fmt::print("{}n{}[\"{}<br/>{}\"]\n", indent, n, last_part(pipeline[n].path), pipeline[n].type->type);
  for (const auto& [name, inner] : group.groups) {
    fmt::print("{}subgraph g_{}{}[\"{}\"]\n", indent, path, name, name);
    print_mermaid_group(pipeline, inner, path + name + "_", depth + 1);
    fmt::print("{}end\n", indent);
  }
}

void print_mermaid(const Pipeline& pipeline) {
  fmt::print("flowchart LR\n");
  print_mermaid_group(pipeline, grouped(pipeline), "", 1);
  for (const auto& edge : boost::make_iterator_range(boost::edges(pipeline)))
    fmt::print("  n{} -- \"{}\" --> n{}\n", boost::source(edge, pipeline), edge_label(pipeline, edge),
               boost::target(edge, pipeline));
  const auto& outputs = pipeline[whole].outputs;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    fmt::print("  n{} --> out{}([\"{}\"])\n", outputs[i].from.node, i, outputs[i].name);
}

}  // namespace

void add_graph(CLI::App& app, int& exit_code) {
  struct Options {
    std::string file, format = "dot";
    std::vector<std::string> settings;
    bool reduced = false;
  };
  auto* verb = app.add_subcommand("graph", "Draws a pipeline: DOT for Graphviz, or Mermaid for Markdown.");
  const auto options = std::make_shared<Options>();
  add_pipeline(*verb, options->file, options->settings);
  verb->add_option("--format", options->format, "dot or mermaid")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"dot", "mermaid"}));
  verb->add_flag("--reduced", options->reduced, "leave out edges that longer ways imply (transitive reduction)");
  verb->callback([options, &exit_code] {
    Registry registry;
    const LoadResult result = load_pipeline(options->file, to_overrides(options->settings), registry,
                                            {.allow_missing = true, .any_files = true});
    print_findings(result);
    exit_code = result.errors.empty() ? ok : invalid;
    if (!result.errors.empty()) return;
    const Pipeline drawn = options->reduced ? reduced(result.pipeline) : result.pipeline;
    if (options->format == "dot")
      print_dot(drawn);
    else
      print_mermaid(drawn);
  });
}

}  // namespace atrium::cli
