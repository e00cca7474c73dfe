#pragma once
#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include "graph/pipeline/document.hpp"

namespace atrium {

/// One -s, taken apart.
struct ParsedOverride {
  std::string node;  ///< "" for a variable of the outermost file, or its seed
  std::string name;  ///< parameter, variable, "type", "pipeline" or "seed"
  Setting setting;
  std::string note;                    ///< "set by -s planes.distance=1cm"
  const SourceFile* source = nullptr;  ///< what relative paths in it are relative to
  bool used = false;
};

/// The command line's settings, by the node that they address.
class Overrides {
 public:
  /// Takes the texts apart. A value in brackets is a list, one in quotes a text; relative paths are meant from the
  /// working folder.
  Overrides(const std::vector<Override>& given, const SourceFile& root, Findings& findings);

  /// What is set of a node ("" for the outermost file's variables), in the order given.
  const std::vector<ParsedOverride*>& of(const std::string& node) const;
  /// The one that sets `name` of `node`, or null.
  const ParsedOverride* find(const std::string& node, const std::string& name) const;
  /// The same. It counts as used.
  ParsedOverride* take(const std::string& node, const std::string& name);

  const std::vector<ParsedOverride>& all() const { return overrides_; }

 private:
  void add(const Override& given, const SourceFile& root, Findings& findings);
  const SourceFile* source_of(const std::filesystem::path& folder);

  std::deque<SourceFile> sources_;
  std::vector<ParsedOverride> overrides_;
  std::unordered_map<std::string, std::vector<ParsedOverride*>> by_node_;
};

}  // namespace atrium
