#pragma once
#include <string>
#include <vector>

#include "graph/cache/file_hashes.hpp"
#include "graph/pipeline/pipeline.hpp"

namespace atrium {

/// All that a node's result depends on, as named texts: the node type with its version and the build of its plugin, the
/// parameters after defaults in their declared units, the seed if the type draws randomness, the contents of the files
/// that it reads, and the content hashes of its inputs. Not in it: the node's address, folders, times, threads.
///
/// Of a file that is read the name (without its folder) is part: what it ends with may tell its format, and a node may
/// show it. Of a file that is written the path within the run's folder is.
struct NodeKey {
  struct Field {
    std::string name, value;
  };
  std::vector<Field> fields;
  std::string hex() const;
};

/// What a node type's code is: the bytes of its plugin (both libraries, the helper programs beside it, the data files
/// that it says it reads) and of Atrium's own libraries. Throws Error if a file of them cannot be read.
class BuildIds {
 public:
  explicit BuildIds(FileHashes& files) : files_(files) {}
  std::string of(const NodeType& type);
  /// Whether its files are still those of which the hash is: somebody may build while a run is under way.
  bool unchanged(const NodeType& type);

 private:
  struct Build {
    std::vector<std::filesystem::path> files;
    std::string fingerprint, hash;
  };
  const Build& build_of(const NodeType& type);

  FileHashes& files_;
  std::mutex mutex_;
  std::map<std::string, Build> known_;  ///< by library
};

/// `inputs`: the content hashes of the values on each input port. Throws Error if a file cannot be read.
NodeKey make_key(const PipelineNode& node, const std::vector<std::vector<std::string>>& inputs,
                 const std::string& build, FileHashes& files);

/// The files and folders that the node's parameters name to be read.
std::vector<std::filesystem::path> input_files(const PipelineNode& node);

}  // namespace atrium
