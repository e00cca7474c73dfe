#include "graph/sweep/forecast.hpp"

#include <algorithm>

#include "graph/cache/costs.hpp"
#include "graph/run/cache_plan.hpp"
#include "graph/sweep/recorder.hpp"

namespace atrium {
namespace {

/// Of the nodes that are wanted: whether the cache has their record.
std::vector<bool> cached_nodes(const Dataflow& graph, const std::vector<std::size_t>& wanted, Cache* cache) {
  std::vector<bool> cached(node_count(graph), false);
  if (cache == nullptr) return cached;
  const Dataflow part = part_of(graph, wanted);
  const auto plan = plan_with_cache(part, topological_order(part), *cache);
  for (std::size_t i = 0; i < wanted.size(); ++i) cached[wanted[i]] = plan[i].found.record.has_value();
  return cached;
}

}  // namespace

SweepForecast forecast(const SweepPlan& plan, const std::vector<bool>& done, Cache* cache) {
  SweepForecast result;
  const Dataflow& graph = plan.merged;
  std::vector<bool> variants = done;
  variants.flip();
  const std::vector<std::size_t> wanted = nodes_of(plan, variants);
  const std::vector<bool> cached = cached_nodes(graph, wanted, cache);
  std::vector<double> seconds_of(node_count(graph), 0);
  Costs costs(cache == nullptr ? CachePlaces{} : cache->places());
  result.nodes.resize(node_count(graph), SweepForecast::Node::cached);
  for (const std::size_t n : wanted) {
    if (cached[n]) {
      ++result.cached;
      continue;
    }
    ++result.to_run;
    const auto cost = cache == nullptr ? std::nullopt : costs.of(graph[n].type->type, address_of(graph[n]));
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
      ++(result.nodes[n] == SweepForecast::Node::cached ? variant.cached : variant.to_run);
      variant.unknown += result.nodes[n] == SweepForecast::Node::unknown_cost ? 1 : 0;
      variant.seconds += seconds_of[n];
    }
  }
  return result;
}

}  // namespace atrium
