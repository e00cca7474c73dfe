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
  std::size_t add(std::string path, std::vector<std::vector<Source>> inputs = {}) {
    PipelineNode node{std::move(path), type_of<N>()};
    node.seed = node_seed(pipeline_[whole].seed, node.path);
    for (const auto& param : node.type->params) node.params.push_back(param.initial);
    // An edge from a node that is not there yet has made a vertex for it, and for those between.
    const std::size_t n = last_ = count_++;
    if (n < node_count(pipeline_))
      pipeline_[n] = std::move(node);
    else
      add_node(std::move(node), pipeline_);
    for (std::size_t input = 0; input < inputs.size(); ++input)
      for (std::size_t place = 0; place < inputs[input].size(); ++place)
        connect(inputs[input][place], n, input, place, pipeline_);
    return n;
  }
  /// Sets a parameter of the node added last.
  PipelineBuilder& set(const std::string& name, ParamValue value) {
    PipelineNode& node = pipeline_[last_];
    for (std::size_t i = 0; i < node.params.size(); ++i)
      if (node.type->params[i].name == name) node.params[i] = std::move(value);
    return *this;
  }
  void output(std::string name, Source from) { pipeline_[whole].outputs.push_back({std::move(name), from}); }
  Pipeline& pipeline() { return pipeline_; }

 private:
  template <class N>
  const NodeType* type_of() {
    for (const auto& type : types_)
      if (type.type == N::type) return &type;
    return &types_.emplace_back(describe_node<N>());
  }

  std::deque<NodeType> types_;
  std::size_t count_ = 0, last_ = 0;
  Pipeline pipeline_;
};

}  // namespace atrium::test
