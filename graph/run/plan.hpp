#pragma once
#include <cstddef>
#include <vector>

#include "graph/pipeline/pipeline.hpp"

namespace atrium {

/// How the nodes of a pipeline wait for each other, by index into Pipeline::nodes.
struct Plan {
  std::vector<std::vector<std::size_t>> followers;  ///< nodes that read an output of the node, each once, ascending
  std::vector<std::size_t> waits;                   ///< number of nodes whose outputs the node reads
  std::vector<std::size_t> remaining;  ///< nodes on the longest path from the node to an end, itself included
  std::vector<std::vector<std::size_t>> readers;  ///< [node][output]: edges and pipeline outputs that need the value
};

/// Throws Error if the nodes wait for each other in a circle.
Plan make_plan(const Pipeline& pipeline);

}  // namespace atrium
