// What nothing uses, and nodes that wait for each other.
#include <fmt/format.h>

#include <algorithm>

#include "graph/pipeline/expansion.hpp"

namespace atrium {
namespace {

/// Where the file wires the edge.
Where place_of(const DataflowEdge& edge, const Expansion& expansion) {
  const Dataflow& graph = expansion.graph;
  const auto& origins = expansion.origins;
  const std::size_t to = boost::target(edge, graph);
  const std::size_t input = graph[edge].input;
  for (const auto& wired : origins[to].source->inputs)
    if (wired.port.text == graph[to].type->inputs[input].name)
      return origins[to].scope->at(wired.sources.at(graph[edge].place).place);
  return origins[to].where();
}

/// The sub-pipelines in which a node runs for its own sake.
std::unordered_set<const Scope*> scopes_with_sinks(const Expansion& expansion) {
  std::unordered_set<const Scope*> result;
  for (const std::size_t n : all_nodes(expansion.graph)) {
    if (expansion.graph[n].type != nullptr && !expansion.graph[n].type->sink) continue;
    for (const Scope* scope = expansion.origins[n].scope; scope != nullptr; scope = scope->parent)
      if (!result.insert(scope).second) break;
  }
  return result;
}

void check_inputs_used(const Scope& scope, Findings& findings) {
  for (const auto& [name, type, default_source] : scope.document->inputs) {
    const auto reads = [&, &text = name.text](const Reference& r) { return r.node == "inputs" && r.port == text; };
    bool used = false;
    for (const auto& node : scope.document->nodes)
      for (const auto& wiring : node.inputs)
        used = used || std::any_of(wiring.sources.begin(), wiring.sources.end(), reads);
    for (const auto& output : scope.document->outputs) used = used || reads(output.source);
    if (!used)
      findings.error(scope.at(name.place), fmt::format("nothing uses the input '{}'", name.text),
                     fmt::format("wire it as 'inputs.{}', or remove it", name.text));
  }
}

}  // namespace

void check_use(const Expansion& expansion, Findings& findings) {
  for (const std::size_t n : all_nodes(expansion.graph)) {
    const NodeType* type = expansion.graph[n].type;
    const NodeOrigin& origin = expansion.origins[n];
    if (type != nullptr && !origin.used && !type->sink)
      findings.error(origin.where(), fmt::format("nothing uses the node '{}' ({})", origin.source->id.text, type->type),
                     "wire one of its outputs, list it under `outputs:`, or remove the node", origin.notes());
  }
  const auto with_sinks = scopes_with_sinks(expansion);
  for (const auto& scope : expansion.scopes)
    if (scope.node != nullptr && !scope.used && !with_sinks.contains(&scope))
      findings.error(scope.parent->at(scope.node->id.place),
                     fmt::format("nothing uses the sub-pipeline '{}'", scope.node->id.text),
                     "wire one of its outputs, list it under `outputs:`, or remove it");
  for (const auto& scope : expansion.scopes) check_inputs_used(scope, findings);
}

void check_cycles(const Expansion& expansion, Findings& findings) {
  const Dataflow& graph = expansion.graph;
  for (const auto& cycle : cycles_of(graph)) {
    std::string path;
    for (const auto& edge : cycle) {
      const PipelineNode& from = graph[boost::source(edge, graph)];
      path += fmt::format("{}.{} → ", from.path, from.type->outputs[graph[edge].output].name);
    }
    const std::size_t last = boost::target(cycle.back(), graph);
    findings.error(place_of(cycle.back(), expansion),
                   fmt::format("the nodes form a cycle: {}{}", path, graph[last].path), "one of these edges must go");
  }
}

}  // namespace atrium
