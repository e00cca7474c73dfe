#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/pipeline/document.hpp"

namespace atrium {

/// What readers of pipeline and sweep files have in common: keys, scalars and mappings of the tree, and what is said
/// when they are not as they should be.
class FileReader {
 protected:
  FileReader(const SourceFile& source, Findings& findings) : source_(source), findings_(findings) {}

  void error(Place place, std::string message, std::string help = {}) {
    findings_.error({&source_, place}, std::move(message), std::move(help));
  }
  void check_keys(const YamlNode& mapping, const std::vector<std::string>& allowed, const std::string& what);
  /// `atrium: 1`
  void check_format(const YamlNode& root);
  /// Line 0: it is none, which has been said.
  Located scalar(const YamlNode::Entry& entry);
  std::optional<std::int64_t> whole(const YamlNode::Entry& entry, std::int64_t low, std::int64_t high);
  /// The entries under a key; none if there is no such key (null).
  const std::vector<YamlNode::Entry>& mapping(const YamlNode::Entry* entry, const std::string& help,
                                              bool may_be_empty = false);

  const SourceFile& source_;
  Findings& findings_;
};

}  // namespace atrium
