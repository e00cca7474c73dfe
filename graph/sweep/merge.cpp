#include "graph/sweep/merge.hpp"

#include <fmt/format.h>

namespace atrium {
namespace {

std::string hash_of_text(const std::string& text) {
  ContentHash hash;
  hash.bytes(text.data(), text.size());
  return hash.hex();
}

}  // namespace

std::string id_of(const Pipeline& pipeline) { return hash_of_text(resolved_yaml(pipeline)).substr(0, 12); }

VariantMerger::Added VariantMerger::add(const Pipeline& pipeline, std::vector<std::size_t> choices) {
  SweepVariant variant{id_of(pipeline), std::move(choices), pipeline.seed};
  const auto [known, fresh] = ids_.try_emplace(variant.id, plan_.variants.size());
  if (!fresh) return {known->second, false};
  plan_.nodes += pipeline.nodes.size();
  for (const PipelineNode& node : pipeline.nodes) variant.nodes.push_back(place(node, variant));
  for (const auto& output : pipeline.outputs)
    variant.outputs.push_back({output.name, {variant.nodes[output.from.node], output.from.output}});
  plan_.variants.push_back(std::move(variant));
  return {plan_.variants.size() - 1, true};
}

std::size_t VariantMerger::place(const PipelineNode& node, const SweepVariant& variant) {
  PipelineNode merged = node;
  std::string text = fmt::format("{}\n{}\n{}\n", node.path, node.type->type, node.type->version);
  if (node.type->random) text += fmt::format("seed {}\n", node.seed);
  for (std::size_t i = 0; i < node.params.size(); ++i)
    text += format_param(node.type->params[i], node.params[i]) + "\n";
  for (auto& port : merged.inputs) {
    text += "in\n";
    for (auto& edge : port) {
      edge.node = variant.nodes[edge.node];
      text += fmt::format("{}.{}\n", keys_[edge.node], edge.output);
    }
  }
  std::string key = hash_of_text(text);
  const auto [known, fresh] = nodes_.try_emplace(key, plan_.merged.nodes.size());
  if (!fresh) return known->second;
  merged.path = variant.id + "/" + node.path;
  merged.folder = std::filesystem::path("variants") / variant.id;
  plan_.merged.nodes.push_back(std::move(merged));
  keys_.push_back(std::move(key));
  return keys_.size() - 1;
}

std::string address_in_variant(const PipelineNode& node) { return node.path.substr(node.path.find('/') + 1); }

Pipeline variant_pipeline(const SweepPlan& plan, const SweepVariant& variant) {
  Pipeline pipeline;
  pipeline.summary = plan.merged.summary;
  pipeline.seed = variant.seed;
  std::unordered_map<std::size_t, std::size_t> place;
  for (std::size_t n = 0; n < variant.nodes.size(); ++n) {
    PipelineNode node = plan.merged.nodes[variant.nodes[n]];
    place.emplace(variant.nodes[n], n);
    node.path = address_in_variant(node);
    node.folder.clear();
    for (auto& port : node.inputs)
      for (auto& edge : port) edge.node = place.at(edge.node);
    pipeline.nodes.push_back(std::move(node));
  }
  for (const auto& output : variant.outputs)
    pipeline.outputs.push_back({output.name, {place.at(output.from.node), output.from.output}});
  return pipeline;
}

Pipeline part_of(const Pipeline& merged, const std::vector<bool>& wanted) {
  Pipeline pipeline;
  pipeline.summary = merged.summary;
  pipeline.file = merged.file;
  std::vector<std::size_t> place(merged.nodes.size(), 0);
  for (std::size_t n = 0; n < merged.nodes.size(); ++n) {
    if (!wanted[n]) continue;
    place[n] = pipeline.nodes.size();
    PipelineNode node = merged.nodes[n];
    for (auto& port : node.inputs)
      for (auto& edge : port) edge.node = place[edge.node];
    pipeline.nodes.push_back(std::move(node));
  }
  return pipeline;
}

}  // namespace atrium
