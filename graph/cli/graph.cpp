// atrium graph FILE: the pipeline as a drawing, for Graphviz (DOT) or Markdown (Mermaid).
#include <fmt/format.h>

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
  for (std::size_t i = 0; i < pipeline.nodes.size(); ++i) {
    Group* group = &root;
    std::string_view rest = pipeline.nodes[i].path;
    for (std::size_t slash = rest.find('/'); slash != std::string_view::npos; slash = rest.find('/')) {
      group = &group->groups[std::string(rest.substr(0, slash))];
      rest.remove_prefix(slash + 1);
    }
    group->nodes.push_back(i);
  }
  return root;
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string edge_label(const Pipeline& pipeline, const PipelineNode& to, std::size_t port, const Edge& edge) {
  const std::string& output = pipeline.nodes[edge.node].type->outputs[edge.output].name;
  const std::string& input = to.type->inputs[port].name;
  return output == input ? output : fmt::format("{} → {}", output, input);
}

template <class F>
void for_each_edge(const Pipeline& pipeline, F f) {
  for (std::size_t i = 0; i < pipeline.nodes.size(); ++i)
    for (std::size_t port = 0; port < pipeline.nodes[i].inputs.size(); ++port)
      for (const auto& edge : pipeline.nodes[i].inputs[port])
        f(edge.node, i, edge_label(pipeline, pipeline.nodes[i], port, edge));
}

void print_dot_group(const Pipeline& pipeline, const Group& group, const std::string& path, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  for (const std::size_t i : group.nodes)
    fmt::print("{}n{} [label=\"{}\\n{}\"];\n", indent, i, last_part(pipeline.nodes[i].path),
               pipeline.nodes[i].type->type);
  for (const auto& [name, inner] : group.groups) {
    fmt::print("{}subgraph \"cluster_{}{}\" {{\n{}  label=\"{}\";\n", indent, path, name, indent, name);
    print_dot_group(pipeline, inner, path + name + "/", depth + 1);
    fmt::print("{}}}\n", indent);
  }
}

void print_dot(const Pipeline& pipeline) {
  fmt::print("digraph pipeline {{\n  rankdir=LR;\n  node [shape=box];\n");
  print_dot_group(pipeline, grouped(pipeline), "", 1);
  for_each_edge(pipeline, [](std::size_t from, std::size_t to, const std::string& label) {
    fmt::print("  n{} -> n{} [label=\"{}\"];\n", from, to, label);
  });
  for (std::size_t i = 0; i < pipeline.outputs.size(); ++i) {
    const auto& output = pipeline.outputs[i];
    const auto& port = pipeline.nodes[output.from.node].type->outputs[output.from.output].name;
    fmt::print("  out{} [label=\"{}\", shape=oval];\n  n{} -> out{} [label=\"{}\"];\n", i, output.name,
               output.from.node, i, port);
  }
  fmt::print("}}\n");
}

void print_mermaid_group(const Pipeline& pipeline, const Group& group, const std::string& path, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  for (const std::size_t i : group.nodes)
    fmt::print("{}n{}[\"{}<br/>{}\"]\n", indent, i, last_part(pipeline.nodes[i].path), pipeline.nodes[i].type->type);
  for (const auto& [name, inner] : group.groups) {
    fmt::print("{}subgraph g_{}{}[\"{}\"]\n", indent, path, name, name);
    print_mermaid_group(pipeline, inner, path + name + "_", depth + 1);
    fmt::print("{}end\n", indent);
  }
}

void print_mermaid(const Pipeline& pipeline) {
  fmt::print("flowchart LR\n");
  print_mermaid_group(pipeline, grouped(pipeline), "", 1);
  for_each_edge(pipeline, [](std::size_t from, std::size_t to, const std::string& label) {
    fmt::print("  n{} -- \"{}\" --> n{}\n", from, label, to);
  });
  for (std::size_t i = 0; i < pipeline.outputs.size(); ++i)
    fmt::print("  n{} --> out{}([\"{}\"])\n", pipeline.outputs[i].from.node, i, pipeline.outputs[i].name);
}

}  // namespace

void add_graph(CLI::App& app, int& exit_code) {
  struct Options {
    std::string file, format = "dot";
    std::vector<std::string> settings;
  };
  auto* verb = app.add_subcommand("graph", "Draws a pipeline: DOT for Graphviz, or Mermaid for Markdown.");
  const auto options = std::make_shared<Options>();
  verb->add_option("FILE", options->file,
                   "the pipeline file, the name of an installed one, or a picture that a run has made (PNG)")
      ->required()
      ->type_name("");
  verb->add_option("--format", options->format, "dot or mermaid")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"dot", "mermaid"}));
  add_settings(*verb, options->settings);
  verb->callback([options, &exit_code] {
    Registry registry;
    const LoadResult result =
        load_pipeline(options->file, to_overrides(options->settings), registry, {.allow_missing = true});
    print_findings(result);
    exit_code = result.errors.empty() ? ok : invalid;
    if (!result.errors.empty()) return;
    if (options->format == "dot")
      print_dot(result.pipeline);
    else
      print_mermaid(result.pipeline);
  });
}

}  // namespace atrium::cli
