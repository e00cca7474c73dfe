#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace atrium {

/// Where something stands in a file: line and column from 1, columns counted in characters.
struct Place {
  int line = 0, column = 0;
};

/// YAML as a pipeline file may use it: mappings with plain keys in the order of the file, lists, scalars as they are
/// written. Nothing is interpreted: `010`, `no` and `1e3` are texts until a parameter says what it wants.
struct YamlNode {
  enum class Kind { null, scalar, sequence, mapping };
  struct Entry;

  Kind kind = Kind::null;
  Place place;          ///< of a null: that of its key
  std::string text;     ///< of a scalar
  bool quoted = false;  ///< a scalar in quotes or in block form (| or >)
  std::vector<YamlNode> items;
  std::vector<Entry> entries;  ///< keys are unique

  bool is_null() const { return kind == Kind::null; }
  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_sequence() const { return kind == Kind::sequence; }
  bool is_mapping() const { return kind == Kind::mapping; }
  const Entry* find(std::string_view key) const;
};
struct YamlNode::Entry {
  std::string key;
  Place place;
  YamlNode value;
};

struct YamlProblem {
  Place place;  ///< line 0: the file as a whole
  std::string message, help;
};

struct YamlTree {
  std::optional<YamlNode> root;  ///< missing after a syntax error
  std::vector<YamlProblem> problems;
};

/// Reads one YAML document. Problems are: syntax errors, bytes that are not UTF-8 text, tabs in the indentation,
/// duplicate and non-plain keys, merge keys, anchors, aliases, tags, a second document, nesting deeper than 32, and no
/// document.
YamlTree parse_yaml(std::string_view text);

/// The bytes of a file, read once (it may be a pipe); nothing if that is a problem: see read_yaml(). A picture may be
/// of any size.
std::optional<std::string> read_yaml_text(const std::string& file, YamlTree& tree);

/// The same from a file; not being able to read it, or its being larger than 16 MiB, is a problem too.
YamlTree read_yaml(const std::string& file);

}  // namespace atrium
