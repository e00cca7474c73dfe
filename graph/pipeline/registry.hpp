#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "graph/api/node.hpp"

namespace atrium {

/// The node types that can be had: plugins libatrium_<module>.so in the folders of ATRIUM_PLUGIN_PATH (':'-separated,
/// first wins), then beside the program (../lib/atrium). A plugin is loaded when a type of its module is first asked
/// for, checked by its stamp, and never unloaded.
class Registry {
 public:
  Registry();
  /// Looks in these folders only.
  explicit Registry(std::vector<std::filesystem::path> folders);
  ~Registry();

  /// The node type, or null when its plugin is there but does not have it, or no plugin of that module is there. Throws
  /// PluginError when the plugin cannot be loaded or was built for another framework, compiler or Eigen alignment.
  const NodeType* find(const std::string& type);
  /// Loads every plugin that can be found; all types by name. What plugins cannot be loaded goes into `problems`, or is
  /// thrown when there is none.
  std::vector<const NodeType*> all(std::vector<std::string>* problems = nullptr);
  /// Adds a type that is in the program itself (tests).
  void add(NodeType type);
  /// Names of all modules whose plugin files exist, loaded or not.
  std::vector<std::string> modules() const;
  /// Whether Atrium's build has that module, but nobody has built it (share/quickstart builds what it needs).
  bool is_left_out(const std::string& module) const;
  /// The library that holds the type's function when that is not there; else "".
  static std::string missing_library(const NodeType& type);
  /// The files of all plugins that can be found, loaded or not, by the name of their modules.
  std::vector<std::filesystem::path> plugin_files() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A plugin that is there but cannot be used (exit code 5).
class PluginError : public Error {
 public:
  using Error::Error;
};

}  // namespace atrium
