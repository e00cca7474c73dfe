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

/// `inputs`: the content hashes of the values on each input port. Throws Error if a file cannot be read.
NodeKey make_key(const PipelineNode& node, const std::vector<std::vector<std::string>>& inputs,
                 const std::string& build, FileHashes& files);

/// The files and folders that the node's parameters name to be read.
std::vector<std::filesystem::path> input_files(const PipelineNode& node);

}  // namespace atrium
