#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "graph/pipeline/document.hpp"

namespace atrium {

/// One -s, taken apart.
struct ParsedOverride {
  std::string node;  ///< "" for a variable of the outermost file, or its seed
  std::string name;  ///< parameter, variable, "type" or "seed"
  Setting setting;
  std::string note;  ///< "set by -s planes.distance=1cm"
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
  /// The one that sets `name` of `node`, or null. It counts as used.
  ParsedOverride* take(const std::string& node, const std::string& name);

  const SourceFile& source() const { return source_; }
  const std::vector<ParsedOverride>& all() const { return overrides_; }

 private:
  void add(const Override& given, const SourceFile& root, Findings& findings);
  SourceFile source_;
  std::vector<ParsedOverride> overrides_;
  std::unordered_map<std::string, std::vector<ParsedOverride*>> by_node_;
};

}  // namespace atrium
