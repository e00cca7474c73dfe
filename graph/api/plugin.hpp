#pragma once
#include <Eigen/Core>
#include <vector>

#include "graph/api/node.hpp"

#define ATRIUM_STRINGIFY_(x) #x
#define ATRIUM_STRINGIFY(x) ATRIUM_STRINGIFY_(x)

/// What must agree between the program and a plugin: framework interface, compiler, Eigen's alignment.
#define ATRIUM_INTERFACE "1"
#define ATRIUM_STAMP \
  "atrium " ATRIUM_INTERFACE "; " __VERSION__ "; Eigen alignment " ATRIUM_STRINGIFY(EIGEN_MAX_STATIC_ALIGN_BYTES)

/// Used once per plugin, in the file that atrium_add_plugin() generates.
#define ATRIUM_PLUGIN(...)                                                                                           \
  extern "C" __attribute__((visibility("default"))) const char* atrium_plugin_stamp() { return ATRIUM_STAMP; }       \
  extern "C" __attribute__((visibility("default"))) void atrium_plugin_nodes(std::vector<atrium::NodeType>& nodes) { \
    ::atrium::detail::add_nodes<__VA_ARGS__>(nodes);                                                                 \
  }

namespace atrium::detail {
template <class... N>
void add_nodes(std::vector<NodeType>& nodes) {
  (nodes.push_back(describe_node<N>()), ...);
}
}  // namespace atrium::detail
