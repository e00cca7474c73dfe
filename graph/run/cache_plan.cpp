#include "graph/run/cache_plan.hpp"

#include <algorithm>

namespace atrium {
namespace {

using Decision = PlannedNode::Decision;

/// Whether the record is of a node with these outputs.
bool fits(const CacheRecord& record, const NodeType& type) {
  return std::equal(record.outputs.begin(), record.outputs.end(), type.outputs.begin(), type.outputs.end(),
                    [](const OutputRecord& output, const PortInfo& port) {
                      return output.port == port.name && output.type == port.type;
                    });
}

class CachePlanner {
 public:
  CachePlanner(const Dataflow& graph, const std::vector<std::size_t>& order, Cache& cache,
               const CachePlanOptions& options)
      : graph_(graph), order_(order), cache_(cache), options_(options), plan_(node_count(graph)) {}

  std::vector<PlannedNode> plan() {
    for (const std::size_t n : order_) plan_[n].needed.resize(graph_[n].type->outputs.size(), 0);
    for (const std::size_t n : order_) decide(n);
    std::for_each(order_.rbegin(), order_.rend(), [this](std::size_t n) { need(n); });
    return std::move(plan_);
  }

 private:
  void decide(std::size_t n) {
    PlannedNode& node = plan_[n];
    node.decision = Decision::open;
    if (const auto* hashes = options_.done ? options_.done(n) : nullptr; hashes != nullptr) {
      node.decision = Decision::hit;
      node.hashes = *hashes;
      return;
    }
    if (options_.stop && options_.stop()) return;
    std::vector<std::vector<std::string>> inputs;
    for (const auto& port : inputs_of(n, graph_)) {
      auto& list = inputs.emplace_back();
      for (const Source& source : port) {
        if (plan_[source.node].hashes.empty()) return;  // it may run, or has failed
        list.push_back(plan_[source.node].hashes.at(source.output));
      }
    }
    node.found = look_up(graph_[n], inputs, cache_);
    if (options_.unusable && options_.unusable(n)) {
      node.found.record.reset();
      node.found.why = "a file that it wrote is not kept any more";
    }
    node.decision = node.found.record ? Decision::hit : Decision::run;
    if (node.found.record)
      for (const auto& output : node.found.record->outputs) node.hashes.push_back(output.hash);
  }

  /// After all that reads it: whether it must give values, and what it needs for that.
  void need(std::size_t n) {
    PlannedNode& node = plan_[n];
    for (std::size_t output = 0; output < node.needed.size(); ++output)
      if (node.decision == Decision::hit && node.needed[output] != 0 && !node.hashes.empty() && !has_value(n, output))
        node.decision = Decision::again;
    if (!node.may_run()) return;
    for (const auto& edge : edges_into(n, graph_)) {
      const Source source = source_of(edge, graph_);
      plan_[source.node].needed[source.output] = 1;
    }
  }

  bool has_value(std::size_t n, std::size_t output) const {
    const std::string& hash = plan_[n].hashes.at(output);
    if (options_.has_value) return options_.has_value(n, output, hash);
    const FlatType* flat = graph_[n].type->outputs[output].flat;
    return flat != nullptr && cache_.has_value(*flat, hash);
  }

  const Dataflow& graph_;
  const std::vector<std::size_t>& order_;
  Cache& cache_;
  const CachePlanOptions& options_;
  std::vector<PlannedNode> plan_;
};

}  // namespace

CacheLookup look_up(const PipelineNode& node, const std::vector<std::vector<std::string>>& inputs, Cache& cache) {
  CacheLookup found;
  if (!node.type->cached) {
    found.why = "nodes of this type are run every time";
    return found;
  }
  for (const auto& list : inputs)
    if (std::find(list.begin(), list.end(), "") != list.end()) {
      found.why = "an input could not be hashed";
      return found;
    }
  try {
    for (const auto& file : input_files(node)) found.files.push_back(FileHashes::fingerprint(file));
    found.key = cache.key_of(node, inputs);
  } catch (const std::exception& error) {
    found.why = error.what();
    return found;
  }
  found.record = cache.find(node.type->type, found.key.hex());
  if (found.record && !fits(*found.record, *node.type)) found.record.reset();
  if (!found.record) found.why = "not computed before";
  return found;
}

std::vector<PlannedNode> plan_with_cache(const Dataflow& graph, const std::vector<std::size_t>& order, Cache& cache,
                                         const CachePlanOptions& options) {
  return CachePlanner(graph, order, cache, options).plan();
}

}  // namespace atrium
