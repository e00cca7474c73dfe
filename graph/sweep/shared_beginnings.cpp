#include "graph/sweep/shared_beginnings.hpp"

#include <map>

#include "graph/sweep/merge.hpp"

namespace atrium {
namespace {

/// Sets of nodes that are joined by edges.
class Components {
 public:
  explicit Components(std::size_t nodes) : parent_(nodes) {
    for (std::size_t n = 0; n < nodes; ++n) parent_[n] = n;
  }
  std::size_t of(std::size_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void join(std::size_t a, std::size_t b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<WorkerTask> shared_beginnings(const SweepPlan& plan, const std::vector<bool>& wanted,
                                          const std::vector<bool>& known) {
  const auto& nodes = plan.merged.nodes;
  std::vector<std::size_t> uses(nodes.size(), 0);
  for (std::size_t v = 0; v < plan.variants.size(); ++v)
    for (const std::size_t n : plan.variants[v].nodes) uses[n] += wanted[v] ? 1 : 0;
  Components components(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const auto& port : nodes[n].inputs)
      for (const Edge& edge : port)
        if (uses[n] > 1) components.join(n, edge.node);  // what a shared node reads is shared, too
  std::vector<bool> lacks(nodes.size(), false);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (uses[n] > 1 && !known[n] && nodes[n].type->cached) lacks[components.of(n)] = true;
  std::map<std::size_t, WorkerTask> tasks;  // by component: in the order of the graph
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (uses[n] < 2 || !lacks[components.of(n)]) continue;
    auto& parts = tasks[components.of(n)].parts;
    const std::string id = nodes[n].path.substr(0, nodes[n].path.find('/'));
    if (parts.empty() || parts.back().id != id) parts.push_back({id, {}});
    parts.back().nodes.push_back(address_in_variant(nodes[n]));
  }
  std::vector<WorkerTask> result;
  result.reserve(tasks.size());
  for (auto& [component, task] : tasks) result.push_back(std::move(task));
  return result;
}

}  // namespace atrium
