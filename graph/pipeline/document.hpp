#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graph/api/parameter.hpp"
#include "graph/pipeline/findings.hpp"

namespace atrium {

/// A word of the file.
struct Located {
  std::string text;
  Place place;
};

/// `name: value` under params or vars. The value stands as it was written, `${variable}` included.
struct Setting {
  Located name;
  RawValue value;
  Place place;          ///< the value's
  bool unset = false;   ///< no value (`scan:`): for a variable, it must be set from outside
  bool broken = false;  ///< the value has been reported: nothing more is said about it
};

/// `node.port`, where an edge begins.
struct Reference {
  std::string node, port;  ///< port is empty when the text has no dot
  Place place;
};

/// `port: node.port` or `port: [node.port, …]` under in.
struct Wiring {
  Located port;
  std::vector<Reference> sources;
  bool is_list = false, broken = false;
};

/// One entry of `nodes`: a node (type) or a sub-pipeline (pipeline).
struct DocumentNode {
  Located id;
  Located type, pipeline;  ///< one of them is given; both empty when that has been reported
  std::vector<Wiring> inputs;
  std::vector<Setting> params;     ///< of a node
  std::vector<Setting> variables;  ///< of a sub-pipeline
};

/// `name: Type` or `name: {type: Type, default: node.port}` under inputs: what a sub-pipeline takes from outside. With
/// a default it may be left unwired, and a file whose inputs all have one runs on its own.
struct DocumentInput {
  Located name, type;
  std::optional<Reference> default_source;
};

struct DocumentOutput {
  Located name;
  Reference source;
};

/// A pipeline file as it stands: its shape checked, nothing known of node types yet.
struct Document {
  SourceFile source;
  std::string identity;  ///< canonical path
  std::string summary;
  std::uint64_t seed = 1;
  std::vector<Setting> variables;
  std::vector<DocumentInput> inputs;
  std::vector<DocumentNode> nodes;
  std::vector<DocumentOutput> outputs;
  std::vector<std::pair<Located, Located>> versions;  ///< node type (or "atrium") and version; resolved files have them
};

/// Reads a file and checks its shape; of a PNG file the pipeline that made it (relative paths in it are meant from the
/// working folder). Null when there is nothing that could be checked further (unreadable, no YAML, no
/// mapping); everything wrong is in `findings`, which refer to `source`'s name.
std::unique_ptr<Document> read_document(const std::filesystem::path& path, std::string name, std::size_t order,
                                        Findings& findings);

/// Documents that have been read, for whoever loads the same files many times with other settings.
class ReadDocuments {
 public:
  /// As read_document; a file that gave no findings is read once.
  std::shared_ptr<const Document> read(const std::filesystem::path& path, const std::string& name, std::size_t order,
                                       Findings& findings);

 private:
  std::map<std::string, std::shared_ptr<const Document>> known_;
};

/// The variable that a value names (`${scan}` → "scan"), or nothing.
std::optional<std::string> variable_of(std::string_view text);
/// A value without its escapes: `$${` stands for `${`.
std::string without_escapes(std::string_view text);
std::string with_escapes(std::string_view text);

/// The value of a scalar or a list of scalars in the tree. Reports what is neither, and `${` inside other text.
Setting read_setting(const Located& name, const YamlNode& node, const SourceFile& source, Findings& findings);

/// Reads a seed: decimal, below 2^64. False when it is none.
bool parse_seed(std::string_view text, std::uint64_t& seed);

/// Names of nodes, variables, inputs and outputs: a letter, then letters, digits and _ (all lower case).
bool is_name(std::string_view text);

}  // namespace atrium
