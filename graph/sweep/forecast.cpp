#include "graph/sweep/forecast.hpp"

#include <algorithm>

#include "graph/cache/costs.hpp"

namespace atrium {
namespace {

/// The hashes of a node's outputs, if the cache knows them.
std::vector<std::string> known_outputs(const PipelineNode& node, const std::vector<std::vector<std::string>>& outputs,
                                       Cache& cache) {
  if (!node.type->cached) return {};
  std::vector<std::vector<std::string>> inputs;
  for (const auto& port : node.inputs) {
    auto& list = inputs.emplace_back();
    for (const Edge& edge : port) {
      if (outputs[edge.node].empty()) return {};
      list.push_back(outputs[edge.node].at(edge.output));
    }
  }
  std::vector<std::string> hashes;
  try {
    const auto record = cache.find(node.type->type, cache.key_of(node, inputs).hex());
    if (!record) return {};
    for (const auto& output : record->outputs) hashes.push_back(output.hash);
  } catch (const Error&) {
    return {};
  }
  hashes.emplace_back();  // also a node without outputs is known
  return hashes;
}

}  // namespace

SweepForecast forecast(const SweepPlan& plan, const std::vector<bool>& done, Cache* cache) {
  SweepForecast result;
  const auto& nodes = plan.merged.nodes;
  std::vector<bool> wanted(nodes.size(), false);
  for (std::size_t v = 0; v < plan.variants.size(); ++v)
    if (!done[v])
      for (const std::size_t n : plan.variants[v].nodes) wanted[n] = true;
  std::vector<std::vector<std::string>> outputs(nodes.size());
  std::vector<double> seconds_of(nodes.size(), 0);
  Costs costs(cache == nullptr ? CachePlaces{} : cache->places());
  result.nodes.resize(nodes.size(), SweepForecast::Node::known);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!wanted[n]) continue;
    if (cache != nullptr) outputs[n] = known_outputs(nodes[n], outputs, *cache);
    if (!outputs[n].empty()) {
      ++result.known;
      continue;
    }
    ++result.to_run;
    const auto cost = cache == nullptr ? std::nullopt : costs.of(nodes[n].type->type, address_of(nodes[n]));
    result.nodes[n] = cost ? SweepForecast::Node::to_run : SweepForecast::Node::unknown_cost;
    result.unknown += cost ? 0 : 1;
    seconds_of[n] = cost ? cost->wall : 0;
    result.seconds += seconds_of[n];
    if (cost) result.memory = std::max(result.memory, cost->memory.value_or(0));
  }
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    auto& variant = result.variants.emplace_back();
    if (done[v]) continue;
    for (const std::size_t n : plan.variants[v].nodes) {
      ++(result.nodes[n] == SweepForecast::Node::known ? variant.known : variant.to_run);
      variant.unknown += result.nodes[n] == SweepForecast::Node::unknown_cost ? 1 : 0;
      variant.seconds += seconds_of[n];
    }
  }
  return result;
}

}  // namespace atrium
