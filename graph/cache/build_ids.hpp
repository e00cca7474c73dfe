#pragma once
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "graph/cache/file_hashes.hpp"
#include "graph/cache/linked_libraries.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium {

/// What a node type's code is, for runs, sweeps and the cache alike: the builds of its plugin (both libraries, and the
/// helper programs beside it) and of all libraries that these are linked with, and the data files that it says it
/// reads. Not in it: the framework itself (its interface has a number), so that a change of the command line does not
/// make results old. Throws Error if a file cannot be read.
class BuildIds {
 public:
  explicit BuildIds(FileHashes& files) : files_(files) {}
  /// With what this processor can do, because mathematical libraries choose by it.
  std::string of(const NodeType& type);
  /// Of a plugin's file (empty: of what is in the program itself), the same on every processor.
  std::string of_library(const std::string& library);
  /// Whether its files are still those of which the hash is: somebody may build while a run is under way. Libraries of
  /// the system are not looked at again.
  bool unchanged(const NodeType& type);

 private:
  struct Build {
    std::vector<std::filesystem::path> files;  ///< its own
    std::string fingerprint, hash;
  };
  const Build& build_of(const std::string& library);
  std::string text_of(const std::filesystem::path& file);

  FileHashes& files_;
  LinkedLibraries libraries_;
  std::mutex mutex_;
  std::map<std::string, Build> known_;  ///< by library
};

/// The build of all plugins that a registry finds, the same on machines with the same packages.
std::string build_of_all(const Registry& registry);

}  // namespace atrium
