#pragma once
#include <deque>
#include <string>
#include <vector>

#include "graph/pipeline/pipeline.hpp"

namespace atrium::test {

/// Puts a Pipeline together by hand, without a file: nodes in the order in which they are added.
class PipelineBuilder {
 public:
  /// One list of edges per input port of the type; parameters have their defaults. Returns the node's index.
  template <class N>
  std::size_t add(std::string path, std::vector<std::vector<Edge>> inputs = {}) {
    PipelineNode node{std::move(path), type_of<N>(), {}, std::move(inputs)};
    node.seed = node_seed(pipeline_.seed, node.path);
    node.inputs.resize(node.type->inputs.size());
    for (const auto& param : node.type->params) node.params.push_back(param.initial);
    pipeline_.nodes.push_back(std::move(node));
    return pipeline_.nodes.size() - 1;
  }
  /// Sets a parameter of the node added last.
  PipelineBuilder& set(const std::string& name, ParamValue value) {
    PipelineNode& node = pipeline_.nodes.back();
    for (std::size_t i = 0; i < node.params.size(); ++i)
      if (node.type->params[i].name == name) node.params[i] = std::move(value);
    return *this;
  }
  void output(std::string name, Edge from) { pipeline_.outputs.push_back({std::move(name), from}); }
  Pipeline& pipeline() { return pipeline_; }

 private:
  template <class N>
  const NodeType* type_of() {
    for (const auto& type : types_)
      if (type.type == N::type) return &type;
    return &types_.emplace_back(describe_node<N>());
  }

  std::deque<NodeType> types_;
  Pipeline pipeline_;
};

}  // namespace atrium::test
