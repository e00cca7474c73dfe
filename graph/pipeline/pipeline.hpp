#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "graph/pipeline/dataflow.hpp"
#include "graph/pipeline/yaml_tree.hpp"

namespace atrium {

/// A dataflow that has passed every check: nodes are in an order in which they can run (ties by the order of the file),
/// every edge joins equal port types, every parameter is in its bounds, every input file exists.
using Pipeline = Dataflow;

/// One finding, as a compiler prints it.
struct Diagnostic {
  std::string file;
  int line = 0, column = 0;  ///< from 1; 0: no place (printed without)
  std::string message, help;
  std::vector<std::string> notes;  ///< "set by sweep.yaml:6:9"
  bool warning = false;
};
std::string to_string(const Diagnostic& diagnostic);

/// One `-s` of the command line: NODE.PARAM=VALUE, NODE.type=TYPE, NODE.pipeline=FILE or VARIABLE=VALUE.
struct Override {
  std::string text;              ///< as given, without -s
  std::string origin;            ///< what notes name: "-s planes.distance=1cm"
  std::filesystem::path folder;  ///< what relative paths in it are relative to; empty: the working folder
  /// The value as another file has it; `text` then only names what is set. Nothing: it stands in `text`.
  std::optional<YamlNode> value = std::nullopt;
};

struct LoadResult {
  Pipeline pipeline;               ///< valid only when errors is empty
  std::vector<Diagnostic> errors;  ///< all of them, in the order of the file
  std::vector<Diagnostic> warnings;
  std::vector<std::string> missing;  ///< with allow_missing: variables without a value, "inputs.NAME" without a source
};

class ReadDocuments;

struct LoadOptions {
  /// A file that is complete but for what its user must give (variables without a value, the inputs of a sub-pipeline)
  /// is no error. Such a pipeline can be looked at, not run.
  bool allow_missing = false;
  ReadDocuments* documents = nullptr;  ///< files that were read by earlier calls; null: all are read
  bool any_files = false;              ///< files that nodes read need not exist: for who only looks at the graph
};

class Registry;

/// Reads and checks a pipeline file, or the picture of a run (PNG, which holds the pipeline that made it): everything
/// before anything runs.
LoadResult load_pipeline(const std::filesystem::path& file, const std::vector<Override>& overrides, Registry& registry,
                         LoadOptions options = {});

/// The seed of a node's random streams.
std::uint64_t node_seed(std::uint64_t run_seed, std::string_view path);

/// Atrium's own version, "0.1.0".
std::string_view framework_version();

/// The pipeline as a file that gives the same bytes when it is run: every default, the seed, absolute paths, no
/// variables, no sub-pipelines (ids with '/' stay addresses). With a folder, the paths within it are relative to it;
/// with `all`, those outside of it, too.
std::string resolved_yaml(const Pipeline& pipeline, const std::filesystem::path& folder = {}, bool all = false);

}  // namespace atrium
