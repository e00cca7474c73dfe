#pragma once
#include <Eigen/Core>
#include <vector>

#include "graph/api/node.hpp"

#define ATRIUM_STRINGIFY_(x) #x
#define ATRIUM_STRINGIFY(x) ATRIUM_STRINGIFY_(x)

/// What must agree between the program and a plugin: framework interface, compiler, Eigen's alignment.
#define ATRIUM_INTERFACE "2"
#define ATRIUM_STAMP \
  "atrium " ATRIUM_INTERFACE "; " __VERSION__ "; Eigen alignment " ATRIUM_STRINGIFY(EIGEN_MAX_STATIC_ALIGN_BYTES)

/// Used once per plugin, in the file that atrium_add_plugin() generates.
#define ATRIUM_PLUGIN(...)                                                                                           \
  extern "C" __attribute__((visibility("default"))) const char* atrium_plugin_stamp() { return ATRIUM_STAMP; }       \
  extern "C" __attribute__((visibility("default"))) void atrium_plugin_nodes(std::vector<atrium::NodeType>& nodes) { \
    ::atrium::detail::add_nodes<__VA_ARGS__>(nodes);                                                                 \
  }

/// The same for a plugin whose functions are in a second library, libatrium_<module>-run.so, which is loaded when one
/// of them is first called: what links large libraries is checked and listed without loading them. Its arguments are
/// two detail::Types: those node types, and the ones whose functions are beside the tables.
#define ATRIUM_LAZY_PLUGIN(...)                                                                                      \
  extern "C" __attribute__((visibility("default"))) const char* atrium_plugin_stamp() { return ATRIUM_STAMP; }       \
  extern "C" __attribute__((visibility("default"))) void atrium_plugin_nodes(std::vector<atrium::NodeType>& nodes) { \
    ::atrium::detail::add_lazy_nodes(__VA_ARGS__, nodes, ATRIUM_STAMP);                                              \
  }

namespace atrium::detail {
/// The function of a node type in the library beside the one that `anchor` is in; throws PluginError when called and
/// the library cannot be loaded.
decltype(NodeType::run) run_of_second_library(const void* anchor, const std::string& type);

template <class... N>
struct Types {};

template <class... N>
void add_nodes([[maybe_unused]] std::vector<NodeType>& nodes) {
  (nodes.push_back(describe_node<N>()), ...);
}
template <class... Lazy, class... Light>
void add_lazy_nodes(Types<Lazy...> /*lazy*/, Types<Light...> /*light*/, std::vector<NodeType>& nodes,
                    const void* anchor) {
  const auto add = [&](NodeType node) {
    node.run = run_of_second_library(anchor, node.type);
    nodes.push_back(std::move(node));
  };
  (add(describe_tables<Lazy>()), ...);
  add_nodes<Light...>(nodes);
}
}  // namespace atrium::detail
