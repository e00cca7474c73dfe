#include "graph/sweep/shared_beginnings.hpp"

#include <boost/pending/disjoint_sets.hpp>
#include <map>

#include "graph/sweep/merge.hpp"

namespace atrium {
std::vector<WorkerTask> shared_beginnings(const SweepPlan& plan, const std::vector<bool>& wanted,
                                          const std::vector<bool>& cached) {
  const Dataflow& graph = plan.merged;
  std::vector<std::size_t> uses(node_count(graph), 0);
  for (std::size_t v = 0; v < plan.variants.size(); ++v)
    for (const std::size_t n : plan.variants[v].nodes) uses[n] += wanted[v] ? 1 : 0;
  boost::disjoint_sets_with_storage<> components(node_count(graph));
  for (const std::size_t n : all_nodes(graph)) components.make_set(n);
  for (const auto& edge : boost::make_iterator_range(boost::edges(graph)))
    if (uses[boost::target(edge, graph)] > 1)  // what a shared node reads is shared, too
      components.union_set(boost::source(edge, graph), boost::target(edge, graph));
  std::vector<bool> lacks(node_count(graph), false);
  for (const std::size_t n : all_nodes(graph))
    if (uses[n] > 1 && !cached[n] && graph[n].type->cached) lacks[components.find_set(n)] = true;
  std::map<std::size_t, std::size_t> task_of;  // by component
  std::vector<WorkerTask> tasks;               // in the order of the graph
  for (const std::size_t n : all_nodes(graph)) {
    const std::size_t component = components.find_set(n);
    if (uses[n] < 2 || !lacks[component]) continue;
    const auto [task, fresh] = task_of.try_emplace(component, tasks.size());
    if (fresh) tasks.emplace_back();
    auto& parts = tasks[task->second].parts;
    const std::string id = graph[n].path.substr(0, graph[n].path.find('/'));
    if (parts.empty() || parts.back().id != id) parts.push_back({id, {}});
    parts.back().nodes.push_back(address_in_variant(graph[n]));
  }
  return tasks;
}

}  // namespace atrium
