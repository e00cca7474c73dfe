#include "graph/sweep/merge.hpp"

#include <fmt/format.h>

#include "graph/cache/places.hpp"

namespace atrium {
std::string id_of(const Pipeline& pipeline, const std::filesystem::path& folder) {
  return hash_of_text(resolved_yaml(pipeline, folder, true)).substr(0, 12);
}

VariantMerger::Added VariantMerger::add(const Pipeline& pipeline, std::vector<std::size_t> choices) {
  SweepVariant variant{id_of(pipeline, folder_), std::move(choices), pipeline[whole].seed};
  const auto [known, fresh] = ids_.try_emplace(variant.id, plan_.variants.size());
  if (!fresh) return {known->second, false};
  plan_.nodes += node_count(pipeline);
  for (const std::size_t n : all_nodes(pipeline)) variant.nodes.push_back(place(n, pipeline, variant));
  for (const auto& output : pipeline[whole].outputs)
    variant.outputs.push_back({output.name, {variant.nodes[output.from.node], output.from.output}});
  plan_.variants.push_back(std::move(variant));
  return {plan_.variants.size() - 1, true};
}

std::size_t VariantMerger::place(std::size_t n, const Pipeline& pipeline, const SweepVariant& variant) {
  const PipelineNode& node = pipeline[n];
  std::string text = fmt::format("{}\n{}\n{}\n", node.path, node.type->type, node.type->version);
  if (node.type->random) text += fmt::format("seed {}\n", node.seed);
  for (std::size_t i = 0; i < node.params.size(); ++i)
    text += format_param(node.type->params[i], node.params[i]) + "\n";
  for (const auto& port : inputs_of(n, pipeline)) {
    text += "in\n";
    for (const Source& source : port) text += fmt::format("{}.{}\n", keys_[variant.nodes[source.node]], source.output);
  }
  std::string key = hash_of_text(text);
  const auto [known, fresh] = nodes_.try_emplace(key, node_count(plan_.merged));
  if (!fresh) return known->second;
  PipelineNode merged = node;
  merged.path = variant.id + "/" + node.path;
  merged.folder = std::filesystem::path("variants") / variant.id;
  const std::size_t placed = add_node(merged, plan_.merged);
  for (const auto& edge : edges_into(n, pipeline))
    boost::add_edge(variant.nodes[boost::source(edge, pipeline)], placed, pipeline[edge], plan_.merged);
  keys_.push_back(std::move(key));
  return placed;
}

std::string address_in_variant(const PipelineNode& node) { return node.path.substr(node.path.find('/') + 1); }

Pipeline variant_pipeline(const SweepPlan& plan, const SweepVariant& variant) {
  Pipeline pipeline = part_of(plan.merged, variant.nodes);
  std::unordered_map<std::size_t, std::size_t> place;
  for (const std::size_t n : all_nodes(pipeline)) {
    place.emplace(variant.nodes[n], n);
    pipeline[n].path = address_in_variant(pipeline[n]);
    pipeline[n].folder.clear();
  }
  PipelineProperties& properties = pipeline[whole];
  properties.seed = variant.seed;
  properties.file.clear();
  for (const auto& output : variant.outputs)
    properties.outputs.push_back({output.name, {place.at(output.from.node), output.from.output}});
  return pipeline;
}

}  // namespace atrium
