#pragma once
#include "graph/cache/cache.hpp"
#include "graph/sweep/plan.hpp"

namespace atrium {

/// What the cache has of a sweep, and what the rest will probably cost.
struct SweepForecast {
  enum class Node { cached, to_run, unknown_cost };  ///< unknown_cost: to run, and no node like it ever ran
  struct Variant {
    std::size_t cached = 0, to_run = 0, unknown = 0;  ///< nodes
    double seconds = 0;                               ///< of its nodes that are to run, shared ones counted in each
  };
  std::vector<Node> nodes;  ///< of SweepPlan::merged
  std::vector<Variant> variants;
  std::size_t cached = 0, to_run = 0, unknown = 0;  ///< nodes; unknown: those of to_run without an estimate
  double seconds = 0;                               ///< one after the other
  std::uint64_t memory = 0;                         ///< of the largest node, bytes

  /// By node of SweepPlan::merged: whether it need not be run.
  std::vector<bool> cached_nodes() const {
    std::vector<bool> list;
    list.reserve(nodes.size());
    for (const Node node : nodes) list.push_back(node == Node::cached);
    return list;
  }
};

/// `done[v]`: variant v is there already and counts for nothing. Null cache: nothing is cached.
SweepForecast forecast(const SweepPlan& plan, const std::vector<bool>& done, Cache* cache);

}  // namespace atrium
